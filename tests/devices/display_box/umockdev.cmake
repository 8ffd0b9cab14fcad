# Devices behind the kernel's own interfaces, on a machine that has none: needs umockdev and is skipped without it.
find_package(PkgConfig REQUIRED)
pkg_check_modules(UMOCKDEV QUIET IMPORTED_TARGET umockdev-1.0)
find_program(OVERT_UMOCKDEV_WRAPPER umockdev-wrapper)
if(NOT UMOCKDEV_FOUND OR NOT OVERT_UMOCKDEV_WRAPPER)
    add_test(NAME "devices behind the system's own interfaces (umockdev)"
        COMMAND ${CMAKE_COMMAND} -E echo "skipped: umockdev and libumockdev-dev are not installed (packages.txt)")
    set_tests_properties("devices behind the system's own interfaces (umockdev)" PROPERTIES LABELS unit
        SKIP_REGULAR_EXPRESSION "skipped: ")
    return()
endif()
add_executable(umockdev_tests ${CMAKE_CURRENT_LIST_DIR}/umockdev_display.cpp ${CMAKE_CURRENT_LIST_DIR}/../hid/umockdev_hid.cpp)

target_link_libraries(umockdev_tests PRIVATE overt_catch_main overt_warnings overt_devices_display_box overt_devices_buttons overt_devices_host PkgConfig::UMOCKDEV)
add_test(NAME "devices behind the system's own interfaces (umockdev)"
    COMMAND ${OVERT_UMOCKDEV_WRAPPER} $<TARGET_FILE:umockdev_tests>)
# The wrapper's library comes before a sanitizer's, and glib keeps what it has allocated.
set_tests_properties("devices behind the system's own interfaces (umockdev)" PROPERTIES LABELS unit TIMEOUT 600
    ENVIRONMENT "${overt_test_environment};ASAN_OPTIONS=verify_asan_link_order=0:detect_leaks=0")
