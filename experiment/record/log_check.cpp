#include "experiment/record/log_check.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "experiment/error.h"

namespace overt {
namespace {

constexpr std::size_t header_bytes = 32, frame_header_bytes = 24;
constexpr std::uint32_t magic = 0x377f0682u; // its last bit says how checksums read the bytes

std::uint32_t big_endian(const unsigned char* bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 |
           bytes[3];
}

/// The running checksum of section 4.2.
class LogChecksum {
  public:
    explicit LogChecksum(bool is_big_endian) : is_big_endian_(is_big_endian) {}

    void add(const unsigned char* bytes, std::size_t count) {
        for (std::size_t i = 0; i + 8 <= count; i += 8) {
            first_ += word(bytes + i) + second_;
            second_ += word(bytes + i + 4) + first_;
        }
    }
    bool is(const unsigned char* bytes) const {
        return first_ == big_endian(bytes) && second_ == big_endian(bytes + 4);
    }

  private:
    std::uint32_t word(const unsigned char* bytes) const {
        const std::uint32_t big = big_endian(bytes);
        return is_big_endian_ ? big : __builtin_bswap32(big);
    }
    bool is_big_endian_;
    std::uint32_t first_ = 0, second_ = 0;
};

bool read_into(std::ifstream& stream, std::vector<unsigned char>& bytes) {
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return static_cast<std::size_t>(stream.gcount()) == bytes.size();
}

} // namespace

std::optional<std::string> log_damage(const std::filesystem::path& log) {
    std::ifstream stream(log, std::ios::binary);
    if (!stream) {
        if (std::filesystem::exists(log))
            throw RecordError(fmt::format("{}: cannot be read. Check its permissions.", log.string()));
        return std::nullopt;
    }
    std::vector<unsigned char> header(header_bytes);
    if (!read_into(stream, header))
        return std::nullopt;
    const std::uint32_t kind = big_endian(header.data());
    LogChecksum checksum((kind & 1u) != 0);
    checksum.add(header.data(), 24);
    const std::size_t page_bytes = big_endian(header.data() + 8);
    if ((kind & ~1u) != magic || !checksum.is(header.data() + 24) || page_bytes < 512 || page_bytes > 65536)
        return "the log's header (its first 32 bytes) is damaged";

    std::vector<unsigned char> frame(frame_header_bytes + page_bytes);
    bool is_over = false;
    for (std::int64_t number = 1; read_into(stream, frame); ++number) {
        const auto place = static_cast<std::size_t>(number - 1) * frame.size() + header_bytes;
        const bool first_salt = std::equal(&header[16], &header[20], &frame[8]);
        const bool second_salt = std::equal(&header[20], &header[24], &frame[12]);
        // What an earlier generation of the log left behind differs in both.
        if (!first_salt && !second_salt) {
            is_over = true;
            continue;
        }
        if (!is_over) {
            checksum.add(frame.data(), 8);
            checksum.add(frame.data() + frame_header_bytes, page_bytes);
        }
        if (is_over || !first_salt || !second_salt || !checksum.is(&frame[16]))
            return fmt::format(
                "frame {} of the log (bytes {} to {}) is damaged: it and what was written after "
                "it cannot be told from what is lost",
                number, place, place + frame.size() - 1);
    }
    return std::nullopt;
}

} // namespace overt
