# Libraries that answer as the vendor's does, loaded by the tests as that one is: today's, one without the functions that
# came later, and one that lacks some that are needed.
foreach(variant "" _old _lacking)
    add_library(stand_in_eyelink${variant} MODULE ${CMAKE_CURRENT_LIST_DIR}/stand_in_eyelink.cpp)
    target_link_libraries(stand_in_eyelink${variant} PRIVATE overt_warnings)
    string(TOUPPER "${variant}" suffix)
    target_compile_definitions(stand_in_eyelink${variant} PRIVATE STAND_IN${suffix})
    add_dependencies(devices_tests stand_in_eyelink${variant})
    target_compile_definitions(devices_tests PRIVATE OVERT_STAND_IN_EYELINK${suffix}="$<TARGET_FILE:stand_in_eyelink${variant}>")
endforeach()
# The program measures with it, too.
add_dependencies(app_tests stand_in_eyelink)
target_compile_definitions(app_tests PRIVATE OVERT_STAND_IN_EYELINK="$<TARGET_FILE:stand_in_eyelink>")
