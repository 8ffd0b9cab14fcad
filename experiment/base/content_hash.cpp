#include "experiment/base/content_hash.h"

#include <array>
#include <fstream>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "experiment/base/error.h"

namespace overt {

struct ContentHasher::State {
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>()) {
    OVERT_EXPECTS(EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr) == 1);
}
ContentHasher::~ContentHasher() = default;
ContentHasher::ContentHasher(ContentHasher&&) noexcept = default;
ContentHasher& ContentHasher::operator=(ContentHasher&&) noexcept = default;

ContentHasher& ContentHasher::add_bytes(std::span<const std::byte> bytes) {
    OVERT_EXPECTS(state_ && EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()) == 1);
    return *this;
}

ContentHasher& ContentHasher::add(std::string_view text) {
    add(text.size());
    return add_bytes(std::as_bytes(std::span(text)));
}

ContentHash ContentHasher::finish() {
    std::array<unsigned char, 32> digest{};
    unsigned length = 0;
    OVERT_EXPECTS(state_ && EVP_DigestFinal_ex(state_->context.get(), digest.data(), &length) == 1);
    state_.reset();
    ContentHash hash;
    for (const unsigned char byte : digest)
        hash += fmt::format("{:02x}", byte);
    return hash;
}

ContentHash hash_of_text(std::string_view text) {
    ContentHasher hasher;
    hasher.add_bytes(std::as_bytes(std::span(text)));
    return hasher.finish();
}

ContentHash hash_of_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw InputError(fmt::format("{}: cannot be read", file.string()));
    ContentHasher hasher;
    // Small enough to lie on the stack: a large buffer, zeroed and mapped anew for each of some thousand
    // frames, takes longer than their hashing.
    std::array<char, 1 << 16> buffer; // NOLINT(cppcoreguidelines-pro-type-member-init): read() fills it
    while (stream) {
        stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        hasher.add_bytes(std::as_bytes(std::span(buffer.data(), static_cast<std::size_t>(stream.gcount()))));
    }
    if (stream.bad())
        throw InputError(fmt::format("{}: reading failed", file.string()));
    return hasher.finish();
}

} // namespace overt
