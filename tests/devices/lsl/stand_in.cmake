# Libraries that answer as liblsl does, loaded by the tests as that one is: today's, one that does not tell how far its
# clock may be off, and one that lacks a function that is needed.
foreach(variant "" _OLD _BROKEN)
    string(TOLOWER fake_liblsl${variant} library)
    add_library(${library} MODULE ${CMAKE_CURRENT_LIST_DIR}/fake_liblsl.cpp)
    target_include_directories(${library} PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${library} PRIVATE overt_warnings)
    target_compile_definitions(${library} PRIVATE FAKE_LSL${variant})
    add_dependencies(devices_tests ${library})
    target_compile_definitions(devices_tests PRIVATE OVERT_FAKE_LIBLSL${variant}="$<TARGET_FILE:${library}>")
endforeach()
# The program loads it as a session's output of markers.
add_dependencies(app_tests fake_liblsl)
target_compile_definitions(app_tests PRIVATE OVERT_FAKE_LIBLSL="$<TARGET_FILE:fake_liblsl>")
