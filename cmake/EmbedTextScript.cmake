# Run by overt_embed_text at build time.
string(REPLACE "," ";" INPUTS "${INPUTS}")
set(text "#pragma once\n#include <string_view>\nnamespace overt::embedded {\n")
foreach(input IN LISTS INPUTS)
    get_filename_component(name ${input} NAME)
    string(REPLACE "." "_" name ${name})
    string(REPLACE "-" "_" name ${name})
    string(TOLOWER ${name} name)
    if(input MATCHES "\\.png$")
        file(READ ${input} content HEX)
        string(REGEX REPLACE "(..)" "\\\\x\\1" content "${content}")
        string(APPEND text "inline constexpr char ${name}_bytes[] = \"${content}\";\n"
                           "inline constexpr std::string_view ${name}{${name}_bytes, sizeof(${name}_bytes) - 1};\n")
        continue()
    endif()
    file(READ ${input} content)
    # Through an array: compilers refuse to count the characters of a long text.
    string(APPEND text "inline constexpr char ${name}_text[] = R\"overt_text(${content})overt_text\";\n"
                       "inline constexpr std::string_view ${name}{${name}_text, sizeof(${name}_text) - 1};\n")
endforeach()
string(APPEND text "} // namespace overt::embedded\n")
file(WRITE ${OUTPUT} "${text}")
