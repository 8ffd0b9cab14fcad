/// Requests to the kernel's drivers, answered by a test: ioctl() of the program devices_tests is that of
/// serial_port_test.cpp.
#pragma once

#include <functional>
#include <optional>

namespace overt::test {

/// What ioctl() gives for a request; nothing: the system's own answer. Below 0: an errno, negated.
inline std::function<std::optional<int>(unsigned long request, void* argument)> answer_to_ioctl;

} // namespace overt::test
