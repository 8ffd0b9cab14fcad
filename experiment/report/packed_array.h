/// Arrays of numbers in JSON: their bytes, little-endian, as base64.
#pragma once

#include <bit>
#include <span>
#include <string>
#include <vector>

#include "experiment/base/base64.h"

namespace overt {

static_assert(std::endian::native == std::endian::little);

template <class T> std::string packed(const std::vector<T>& numbers) {
    return base64_of(std::as_bytes(std::span(numbers)));
}

} // namespace overt
