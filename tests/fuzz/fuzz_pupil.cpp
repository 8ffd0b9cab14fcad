#include <cstddef>
#include <cstdint>

#include "tests/devices/pupil/any_pupil.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    overt::test::take_any_pupil({reinterpret_cast<const char*>(data), size});
    return 0;
}
