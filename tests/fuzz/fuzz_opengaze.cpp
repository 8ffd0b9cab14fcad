#include <cstddef>
#include <cstdint>

#include "tests/devices/opengaze/any_opengaze.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    overt::test::take_any_opengaze({reinterpret_cast<const char*>(data), size});
    return 0;
}
