# Run by `cmake --install`, with overt_program and overt_limits set: what the program writes of itself, and what lies outside
# of the prefix.
set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(zsh_folder vendor-completions)
else()
    set(zsh_folder site-functions)
endif()

set(man "${root}/share/man/man1")
message(STATUS "Installing: ${man}/overt*.1.gz")
file(GLOB old "${man}/overt.1.gz" "${man}/overt-*.1.gz")
if(old)
    file(REMOVE ${old})
endif()
execute_process(COMMAND "${overt_program}" man-pages "${man}" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB pages "${man}/overt.1" "${man}/overt-*.1")
# Without the time, so that the same program gives the same files.
execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)

foreach(script IN ITEMS "bash=bash-completion/completions/overt" "zsh=zsh/${zsh_folder}/_overt"
                        "fish=fish/vendor_completions.d/overt.fish")
    string(REGEX REPLACE "=.*" "" shell ${script})
    string(REGEX REPLACE ".*=" "" place ${script})
    message(STATUS "Installing: ${root}/share/${place}")
    get_filename_component(folder "${root}/share/${place}" DIRECTORY)
    file(MAKE_DIRECTORY "${folder}")
    execute_process(COMMAND "${overt_program}" completion ${shell} OUTPUT_FILE "${root}/share/${place}"
                    COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# file(INSTALL) puts DESTDIR before its destination by itself.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    file(INSTALL "${overt_limits}" DESTINATION "/etc/security/limits.d")
else()
    file(INSTALL "${overt_limits}" DESTINATION "${CMAKE_INSTALL_PREFIX}/share/overt/limits.d")
endif()
