#include "experiment/base/base64.h"

#include <algorithm>

#include <openssl/evp.h>

namespace overt {

std::string base64_of(std::span<const std::byte> bytes) {
    std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0'); // OpenSSL ends it by a zero
    const int length =
        EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                        reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
    text.resize(static_cast<std::size_t>(length));
    return text;
}

std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text) {
    std::vector<std::byte> bytes((text.size() + 3) / 4 * 3);
    const int length =
        EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                        reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
    if (length < 0)
        return std::nullopt;
    // OpenSSL takes padding for zeros, and lets pass what is not written by base64_of().
    const std::size_t padding = text.size() - (text.find_last_not_of('=') + 1);
    bytes.resize(static_cast<std::size_t>(length) - std::min(padding, static_cast<std::size_t>(length)));
    return base64_of(bytes) == text ? std::optional(std::move(bytes)) : std::nullopt;
}

} // namespace overt
