#include "experiment/record/verify/log_check.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

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

/// The log's bytes, a frame at a time.
class LogFrames {
  public:
    LogFrames(std::ifstream& stream, std::vector<unsigned char> header)
        : stream_(stream), header_(std::move(header)), checksum_((big_endian(header_.data()) & 1u) != 0),
          page_bytes_(big_endian(header_.data() + 8)) {
        checksum_.add(header_.data(), 24);
        is_header_whole_ = (big_endian(header_.data()) & ~1u) == magic && checksum_.is(header_.data() + 24) &&
                           page_bytes_ >= 512 && page_bytes_ <= 65536;
    }

    bool is_header_whole() const { return is_header_whole_; }

    /// Goes to the next; false if the log does not hold all of it.
    bool next() {
        frame_.assign(frame_header_bytes + page_bytes_, 0);
        stream_.read(reinterpret_cast<char*>(frame_.data()), static_cast<std::streamsize>(frame_.size()));
        begun_ = static_cast<std::size_t>(stream_.gcount());
        ++number_;
        return begun_ == frame_.size();
    }
    /// After next() was false: some of its bytes are there.
    bool is_begun() const { return begun_ > 0; }

    /// It carries on from the frame before it. Once false, it is so for all that follow.
    bool fits() {
        if (!has_salts(2))
            return false;
        checksum_.add(frame_.data(), 8);
        checksum_.add(frame_.data() + frame_header_bytes, page_bytes_);
        return checksum_.is(&frame_[16]);
    }

    /// As many of the two numbers by which the log marks its frames. What is not of this log has none.
    bool has_salts(int count) const {
        return std::equal(&header_[16], &header_[20], &frame_[8]) +
                   std::equal(&header_[20], &header_[24], &frame_[12]) >=
               count;
    }
    bool is_commit() const { return big_endian(&frame_[4]) != 0; }

    /// How many zeros the frame ends with.
    std::size_t last_zeros() const {
        const auto last =
            std::find_if(frame_.rbegin(), frame_.rend(), [](unsigned char c) { return c != 0; });
        return static_cast<std::size_t>(last - frame_.rbegin());
    }
    bool is_all_zeros() const { return last_zeros() == frame_.size(); }
    /// Zeros from before the end of the first salt on: the writing ended within the frame's first bytes, or
    /// before it. What is of an earlier use of the log's space has salts there.
    bool has_no_salts() const { return last_zeros() > frame_.size() - 12; }

    std::int64_t number() const { return number_; }
    std::size_t first_byte() const {
        return static_cast<std::size_t>(number_ - 1) * frame_.size() + header_bytes;
    }
    std::size_t last_byte() const { return first_byte() + frame_.size() - 1; }

  private:
    std::ifstream& stream_;
    std::vector<unsigned char> header_, frame_;
    LogChecksum checksum_;
    std::size_t page_bytes_, begun_ = 0;
    std::int64_t number_ = 0;
    bool is_header_whole_ = false;
};

LogFinding cut_off_at(std::int64_t frame, std::size_t byte) {
    return {LogFinding::Kind::cut_off,
            fmt::format("is cut off at frame {} (byte {}), where it was being written when the program or "
                        "the machine stopped: all that was committed before is there",
                        frame, byte)};
}

/// Of a log whose frame that was read last does not fit.
std::optional<LogFinding> judge_rest(LogFrames& frames) {
    // A disk writes whole sectors: what was not written reads as zeros to the end.
    constexpr std::size_t sector_bytes = 512;
    const std::int64_t number = frames.number();
    const std::size_t first = frames.first_byte(), last = frames.last_byte();
    bool belongs_to_log = frames.has_salts(1);
    bool ends_in_zeros = belongs_to_log ? frames.last_zeros() >= sector_bytes : frames.has_no_salts();
    const bool is_one_salt_off = frames.has_salts(1) && !frames.has_salts(2);
    bool has_commit = frames.has_salts(2) && frames.is_commit();
    while (frames.next()) {
        ends_in_zeros &= frames.is_all_zeros();
        has_commit |= frames.has_salts(2) && frames.is_commit();
        belongs_to_log |= frames.has_salts(1);
    }
    if (!belongs_to_log && !ends_in_zeros)
        return std::nullopt; // of an earlier use of the log's space
    if (ends_in_zeros || (!has_commit && !is_one_salt_off))
        return cut_off_at(number, first);
    return LogFinding{
        LogFinding::Kind::damaged,
        fmt::format("frame {} of the log (bytes {} to {}) is damaged: it and what was written after it "
                    "cannot be told from what is lost",
                    number, first, last)};
}

} // namespace

std::optional<LogFinding> look_through_log(const std::filesystem::path& log) {
    std::ifstream stream(log, std::ios::binary);
    if (!stream) {
        if (std::filesystem::exists(log))
            throw RecordError(fmt::format("{}: cannot be read. Check its permissions.", log.string()));
        return std::nullopt;
    }
    std::vector<unsigned char> header(header_bytes);
    stream.read(reinterpret_cast<char*>(header.data()), header_bytes);
    if (stream.gcount() == 0)
        return std::nullopt;
    if (stream.gcount() < static_cast<std::streamsize>(header_bytes))
        return cut_off_at(1, 0);
    LogFrames frames(stream, std::move(header));
    if (!frames.is_header_whole())
        return LogFinding{LogFinding::Kind::damaged,
                          "the log's header (its first 32 bytes) is damaged: nothing in it can be read"};
    while (frames.next())
        if (!frames.fits())
            return judge_rest(frames);
    if (frames.is_begun())
        return cut_off_at(frames.number(), frames.first_byte());
    return std::nullopt;
}

} // namespace overt
