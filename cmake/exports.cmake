# Writes the list of a shared library's exported names for the linker (a version script).
#
#   cmake -DFOLDER=include/abut -DOUTPUT=FILE -DVERSION=0.2 [-DUSER=ARCHIVE -DNM=nm] -P exports.cmake
#
# Exported are the classes that the headers define, with all their members, and the functions that they
# declare at namespace scope. A declaration begins in the first column there, as clang-format has it.
# Classes that are only declared are inner ones. USER is an archive of which every undefined name of
# namespace abut is exported too.
file(GLOB headers ${FOLDER}/*.h)
set(classes)
set(functions)
set(c_functions)
foreach(header IN LISTS headers)
    file(READ ${header} text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REPLACE ";" "@" text "${text}") # a list's separator
    string(REPLACE "[" "(" text "${text}")
    string(REPLACE "]" ")" text "${text}")
    string(REPLACE "\n" ";" lines "${text}")
    foreach(line IN LISTS lines)
        if(line MATCHES "^(class|struct|union) (alignas.[0-9]+. )?([A-Za-z0-9_]+)( final)?( :.*| {.*)?$")
            list(APPEND classes ${CMAKE_MATCH_3})
        elseif(line MATCHES "^(inline|constexpr|template|using|namespace|static|typedef|enum|#|})")
            continue()
        elseif(line MATCHES "^[a-z][a-z0-9_ *]*[ *](abut_[a-z0-9_]+)\\(") # abut/c.h
            list(APPEND c_functions ${CMAKE_MATCH_1})
        elseif(line MATCHES "^([A-Za-z_][^(]*[ *&])?([A-Za-z0-9_]+)\\(")
            list(APPEND functions ${CMAKE_MATCH_2})
        endif()
    endforeach()
endforeach()
foreach(names classes functions c_functions)
    list(REMOVE_DUPLICATES ${names})
    list(SORT ${names})
endforeach()

set(map "# Made by cmake/exports.cmake from the public headers.\nABUT_${VERSION} {\nglobal:\n")
foreach(name IN LISTS c_functions)
    string(APPEND map "    ${name};\n")
endforeach()
if(USER)
    execute_process(COMMAND ${NM} --undefined-only --format=posix ${USER} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "_Z[A-Za-z0-9_]*4abut[A-Za-z0-9_]*" symbols "${symbols}")
    execute_process(COMMAND ${NM} --defined-only --format=posix ${USER} OUTPUT_VARIABLE own COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "_Z[A-Za-z0-9_]*4abut[A-Za-z0-9_]*" own "${own}")
    list(REMOVE_ITEM symbols ${own})
    list(REMOVE_DUPLICATES symbols)
    list(SORT symbols)
    string(APPEND map "    # for Abut::render\n")
    foreach(name IN LISTS symbols)
        string(APPEND map "    ${name};\n")
    endforeach()
endif()
string(APPEND map "    extern \"C++\" {\n")
foreach(name IN LISTS classes)
    string(APPEND map "        abut::${name}::*;\n        \"typeinfo for abut::${name}\";\n"
           "        \"typeinfo name for abut::${name}\";\n        \"vtable for abut::${name}\";\n")
endforeach()
# The character after the name is "(" or that of a tag, "[abi:cxx11]".
foreach(name IN LISTS functions)
    string(APPEND map "        abut::${name}[^a-zA-Z0-9_]*;\n")
endforeach()
string(APPEND map "    };\nlocal: *;\n};\n")
file(WRITE ${OUTPUT} "${map}")
