# Embeds the report page's sources into the library. If src/CMakeLists.txt includes this file, it adds the
# build rules: esbuild joins three.js and page/scene into one script, if tools/install_dependencies has
# installed them; then this file runs with `cmake -P` and writes report_page.cpp, in which each source is a
# raw string.
if(NOT CMAKE_SCRIPT_MODE_FILE)
    set(page_dir ${CMAKE_CURRENT_LIST_DIR})
    set(page_cpp ${CMAKE_CURRENT_BINARY_DIR}/report_page.cpp)
    set(scene_js ${CMAKE_CURRENT_BINARY_DIR}/report_scene.js)
    # The notices of what is joined, also for cmake/copyright.cmake. The script begins with them.
    set(scene_notices ${PROJECT_BINARY_DIR}/copyright/report_scene.txt)
    file(GLOB page_sources CONFIGURE_DEPENDS ${page_dir}/*.js ${page_dir}/*.css ${page_dir}/*.html)
    file(GLOB scene_sources CONFIGURE_DEPENDS ${page_dir}/scene/*.js)
    find_program(ABUT_NODE node)
    mark_as_advanced(ABUT_NODE)
    set(scene_modules ${page_dir}/scene/node_modules)
    if(ABUT_NODE AND EXISTS ${scene_modules}/three/package.json AND EXISTS ${scene_modules}/esbuild/package.json)
        add_custom_command(
            OUTPUT ${scene_js} ${scene_notices}
            COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/copyright
            COMMAND ${ABUT_NODE} ${page_dir}/scene/bundle.mjs ${scene_js} ${scene_notices}
            DEPENDS ${scene_sources} ${page_dir}/scene/bundle.mjs ${page_dir}/scene/package-lock.json ${CMAKE_CURRENT_LIST_FILE}
            COMMENT "Bundling the 3D view of the report page"
            VERBATIM)
    else()
        message(STATUS "Without three.js: report.html has no 3D view. tools/install_dependencies build gets it.")
        file(WRITE ${scene_js} "")
        file(WRITE ${scene_notices} "")
    endif()
    add_custom_command(
        OUTPUT ${page_cpp}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${page_cpp} -DSCENE=${scene_js} -P ${CMAKE_CURRENT_LIST_FILE}
        DEPENDS ${page_sources} ${scene_js} ${CMAKE_CURRENT_LIST_FILE}
        COMMENT "Embedding the report page"
        VERBATIM)
    target_sources(abut PRIVATE ${page_cpp})
    return()
endif()

cmake_policy(VERSION 3.25)

# Reads files, one after the other.
function(read_all out)
    set(content "")
    foreach(file IN LISTS ARGN)
        cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_LIST_DIR})
        file(READ ${file} text)
        string(APPEND content "${text}")
    endforeach()
    set(${out} "${content}" PARENT_SCOPE)
endfunction()

# Returns the source expression of a Content-Security-Policy for a text: 'sha256-…' in base64.
function(csp_hash out text)
    set(digits "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
    string(SHA256 hex "${text}")
    string(APPEND hex "00") # 33 bytes are 11 groups of 3; the last digit becomes the padding
    set(base64 "")
    foreach(group RANGE 10)
        math(EXPR at "6 * ${group}")
        string(SUBSTRING ${hex} ${at} 6 word)
        foreach(shift 18 12 6 0)
            math(EXPR digit "(0x${word} >> ${shift}) & 63")
            string(SUBSTRING ${digits} ${digit} 1 digit)
            string(APPEND base64 ${digit})
        endforeach()
    endforeach()
    string(SUBSTRING ${base64} 0 43 base64)
    set(${out} "'sha256-${base64}='" PARENT_SCOPE)
endfunction()

read_all(html report.html)
read_all(style report.css stage.css print.css)
read_all(script data.js groups.js table.js summary.js filters.js state.js detail.js review.js overview.js plan.js
         history.js building.js page.js)
read_all(scene ${SCENE})
csp_hash(style_hash "${style}")
csp_hash(script_hash "${script}")
csp_hash(scene_hash "${scene}")
string(REPLACE "@CSP_STYLE@" "${style_hash}" html "${html}")
string(REPLACE "@CSP_SCRIPT@" "${script_hash} ${scene_hash}" html "${html}")

set(cpp "// Made by src/clash/report/page/embed.cmake; change the page's sources there.\n#include \"clash/report/report_page.h\"\n")
string(APPEND cpp "\nnamespace abut::report_page {\n")
foreach(name html style script scene)
    foreach(forbidden ")embedded\"" "</script" "<!--")
        string(FIND "${${name}}" "${forbidden}" at)
        if(NOT at EQUAL -1 AND NOT (name STREQUAL "html" AND forbidden MATCHES "<"))
            message(FATAL_ERROR "The page's ${name} has ${forbidden}, which would end what it is embedded in")
        endif()
    endforeach()
    string(APPEND cpp "const std::string_view ${name} = R\"embedded(${${name}})embedded\";\n")
endforeach()
string(APPEND cpp "} // namespace abut::report_page\n")
file(WRITE ${OUTPUT} "${cpp}")
