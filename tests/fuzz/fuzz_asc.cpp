#include <cstddef>
#include <cstdint>

#include "tests/fuzz/inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    overt::fuzz::take_asc({reinterpret_cast<const char*>(data), size}, overt::fuzz::Depth::by_content);
    return 0;
}
