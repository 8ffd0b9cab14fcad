# A parallel port by the kernel's ppdev, on a machine that has none; in the program that runs under umockdev-wrapper.
if(TARGET umockdev_tests)
    target_sources(umockdev_tests PRIVATE ${CMAKE_CURRENT_LIST_DIR}/umockdev_parallel.cpp)
    target_link_libraries(umockdev_tests PRIVATE overt_devices_triggers)
endif()
