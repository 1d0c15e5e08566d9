# Embeds the report page's sources into the library. If src/CMakeLists.txt includes this file, it adds the
# build rule. The rule runs this file with `cmake -P`: then it writes report_page.cpp, in which each source is
# a raw string.
if(NOT CMAKE_SCRIPT_MODE_FILE)
    set(page_dir ${CMAKE_CURRENT_LIST_DIR})
    set(page_cpp ${CMAKE_CURRENT_BINARY_DIR}/report_page.cpp)
    add_custom_command(
        OUTPUT ${page_cpp}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${page_cpp} -P ${CMAKE_CURRENT_LIST_FILE}
        DEPENDS ${page_dir}/report.html ${page_dir}/report.css ${page_dir}/data.js ${page_dir}/table.js
                ${page_dir}/page.js ${CMAKE_CURRENT_LIST_FILE}
        COMMENT "Embedding the report page"
        VERBATIM)
    target_sources(abut PRIVATE ${page_cpp})
    return()
endif()

set(cpp "// Made by src/clash/report/page/embed.cmake; change the page's sources there.\n#include \"clash/report/report_page.h\"\n")
string(APPEND cpp "\nnamespace abut::report_page {\n")
foreach(entry html=report.html style=report.css script=data.js,table.js,page.js)
    string(REGEX MATCH "^(.*)=(.*)$" _ ${entry})
    set(name ${CMAKE_MATCH_1})
    string(REPLACE "," ";" files ${CMAKE_MATCH_2})
    set(content "")
    foreach(file IN LISTS files)
        file(READ ${CMAKE_CURRENT_LIST_DIR}/${file} text)
        string(APPEND content "${text}")
    endforeach()
    string(FIND "${content}" ")embedded\"" at)
    if(NOT at EQUAL -1)
        message(FATAL_ERROR "${files}: holds the delimiter of the raw string that it is embedded in")
    endif()
    string(APPEND cpp "const std::string_view ${name} = R\"embedded(${content})embedded\";\n")
endforeach()
string(APPEND cpp "} // namespace abut::report_page\n")
file(WRITE ${OUTPUT} "${cpp}")
