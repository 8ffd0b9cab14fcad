#include <cstddef>
#include <cstdint>

#include "tests/fuzz/more_inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    overt::fuzz::take_labels({reinterpret_cast<const char*>(data), size});
    return 0;
}
