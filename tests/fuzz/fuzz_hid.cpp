#include <cstddef>
#include <cstdint>

#include "tests/devices/hid/any_hid.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    overt::test::take_any_hid({reinterpret_cast<const std::byte*>(data), size});
    return 0;
}
