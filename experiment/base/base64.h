/// Bytes as letters (RFC 4648, section 4).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

/// With padding, without line breaks.
std::string base64_of(std::span<const std::byte> bytes);

/// Nothing for what base64_of() does not write.
std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text);

} // namespace overt
