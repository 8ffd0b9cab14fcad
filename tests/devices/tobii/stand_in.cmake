# Libraries that answer as Tobii's does, loaded by the tests as that one is: of versions 2 and 1, whose data differ, one of a
# version that is not known, and one that lacks a function that is needed.
foreach(variant "" _1 _3 _lacking)
    add_library(stand_in_tobii${variant} MODULE ${CMAKE_CURRENT_LIST_DIR}/stand_in_tobii.cpp)
    target_link_libraries(stand_in_tobii${variant} PRIVATE overt_warnings Threads::Threads)
    string(TOUPPER "${variant}" suffix)
    target_compile_definitions(stand_in_tobii${variant} PRIVATE STAND_IN${suffix})
    add_dependencies(devices_tests stand_in_tobii${variant})
    target_compile_definitions(devices_tests PRIVATE OVERT_STAND_IN_TOBII${suffix}="$<TARGET_FILE:stand_in_tobii${variant}>")
endforeach()
# The program measures with it, too.
add_dependencies(app_tests stand_in_tobii)
target_compile_definitions(app_tests PRIVATE OVERT_STAND_IN_TOBII="$<TARGET_FILE:stand_in_tobii>")
