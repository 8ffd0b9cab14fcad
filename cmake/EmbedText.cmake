# overt_embed_text(TARGET HEADER FILES…): makes each text file a `constexpr std::string_view NAME` (its name in small letters,
# with dots as underscores) in namespace overt::embedded, in a header generated at build time. Shaders travel in the executable this way.
function(overt_embed_text target header)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/generated/${header})
    # Files of a package are named by their whole path.
    set(inputs ${ARGN})
    list(TRANSFORM inputs PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
    string(REPLACE ";" "," joined "${inputs}")
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DINPUTS=${joined} -P ${CMAKE_SOURCE_DIR}/cmake/EmbedTextScript.cmake
        DEPENDS ${inputs} ${CMAKE_SOURCE_DIR}/cmake/EmbedTextScript.cmake
        VERBATIM)
    target_sources(${target} PRIVATE ${output})
    # A target of its own: the header needs none of the libraries that TARGET is linked to, so it need not wait for them.
    add_custom_target(${target}_${header} DEPENDS ${output})
    add_dependencies(${target} ${target}_${header})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
endfunction()
