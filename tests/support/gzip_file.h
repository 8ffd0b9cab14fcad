/// A gzip file read back with zlib, and what stands in its header.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <zlib.h>

namespace overt::testing {

inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string unpacked(const std::filesystem::path& file) {
    const gzFile stream = gzopen(file.c_str(), "rb");
    if (!stream)
        throw std::runtime_error(file.string() + " cannot be opened");
    std::string text;
    char piece[65536];
    int count = 0;
    while ((count = gzread(stream, piece, sizeof(piece))) > 0)
        text.append(piece, static_cast<std::size_t>(count));
    gzclose(stream);
    if (count < 0)
        throw std::runtime_error(file.string() + " is damaged");
    return text;
}

/// Neither a name (bit 3 of byte 3) nor a time (bytes 4 to 7).
inline bool is_anonymous_gzip(const std::filesystem::path& file) {
    const std::string bytes = bytes_of(file);
    return bytes.size() > 18 && bytes[0] == '\x1f' && bytes[1] == '\x8b' && (bytes[3] & 0x08) == 0 &&
           bytes.substr(4, 4) == std::string(4, '\0');
}

} // namespace overt::testing
