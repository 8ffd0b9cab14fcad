#include "devices/pupil/msgpack_reader.h"

#include <bit>

namespace overt {

std::uint64_t MsgpackReader::big_endian(int bytes) noexcept {
    if (rest_.size() < static_cast<std::size_t>(bytes)) {
        failed_ = true;
        return 0;
    }
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i)
        value = value << 8 | static_cast<std::uint8_t>(rest_[static_cast<std::size_t>(i)]);
    rest_.remove_prefix(static_cast<std::size_t>(bytes));
    return value;
}

MsgpackReader::Head MsgpackReader::content(Kind kind, std::uint64_t length) noexcept {
    if (failed_ || rest_.size() < length) {
        failed_ = true;
        return {};
    }
    const std::string_view bytes = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return {.kind = kind, .content = bytes};
}

MsgpackReader::Head MsgpackReader::head_of(std::uint8_t byte) noexcept {
    const auto counted = [](Kind kind, std::uint64_t count) {
        return Head{.kind = kind, .count = static_cast<std::uint32_t>(count)};
    };
    const auto whole = [](auto value) {
        return Head{.kind = Kind::number, .number = static_cast<double>(value)};
    };
    if (byte <= 0x7f)
        return whole(byte);
    if (byte <= 0x8f)
        return counted(Kind::map, byte & 0x0fu);
    if (byte <= 0x9f)
        return counted(Kind::array, byte & 0x0fu);
    if (byte <= 0xbf)
        return content(Kind::text, byte & 0x1fu);
    if (byte >= 0xe0)
        return whole(static_cast<std::int8_t>(byte));
    switch (byte) {
    case 0xc0:
        return {.kind = Kind::nil};
    case 0xc2:
    case 0xc3:
        return {.kind = Kind::boolean, .number = byte == 0xc3 ? 1.0 : 0.0};
    case 0xc4:
    case 0xc5:
    case 0xc6:
        return content(Kind::binary, big_endian(1 << (byte - 0xc4)));
    case 0xc7:
    case 0xc8:
    case 0xc9:
        return content(Kind::extension, big_endian(1 << (byte - 0xc7)) + 1);
    case 0xca:
        return whole(std::bit_cast<float>(static_cast<std::uint32_t>(big_endian(4))));
    case 0xcb:
        return whole(std::bit_cast<double>(big_endian(8)));
    case 0xcc:
    case 0xcd:
    case 0xce:
    case 0xcf:
        return whole(big_endian(1 << (byte - 0xcc)));
    case 0xd0:
        return whole(static_cast<std::int8_t>(big_endian(1)));
    case 0xd1:
        return whole(static_cast<std::int16_t>(big_endian(2)));
    case 0xd2:
        return whole(static_cast<std::int32_t>(big_endian(4)));
    case 0xd3:
        return whole(static_cast<std::int64_t>(big_endian(8)));
    case 0xd4:
    case 0xd5:
    case 0xd6:
    case 0xd7:
    case 0xd8:
        return content(Kind::extension, (std::uint64_t{1} << (byte - 0xd4)) + 1);
    case 0xd9:
    case 0xda:
    case 0xdb:
        return content(Kind::text, big_endian(1 << (byte - 0xd9)));
    case 0xdc:
    case 0xdd:
        return counted(Kind::array, big_endian(byte == 0xdc ? 2 : 4));
    case 0xde:
    case 0xdf:
        return counted(Kind::map, big_endian(byte == 0xde ? 2 : 4));
    default: // 0xc1 is never used
        failed_ = true;
        return {};
    }
}

MsgpackReader::Head MsgpackReader::next() noexcept {
    if (rest_.empty())
        failed_ = true;
    if (failed_)
        return {};
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    const Head head = head_of(byte);
    return failed_ ? Head{} : head;
}

void MsgpackReader::pass_over(const Head& head) noexcept {
    // Each head takes a byte at least, so this ends with the bytes whatever the counts promise.
    const auto within = [](const Head& each) -> std::uint64_t {
        if (each.kind == Kind::map)
            return 2 * std::uint64_t{each.count};
        return each.kind == Kind::array ? each.count : 0;
    };
    for (std::uint64_t pending = within(head); pending > 0 && !failed_; --pending)
        pending += within(next());
}

void MsgpackReader::skip() noexcept { pass_over(next()); }

template <class Value> std::optional<Value> MsgpackReader::next_of(Kind kind, Value Head::*part) noexcept {
    const Head head = next();
    if (head.kind == kind)
        return head.*part;
    pass_over(head);
    return std::nullopt;
}

std::optional<double> MsgpackReader::number() noexcept { return next_of(Kind::number, &Head::number); }

std::optional<std::string_view> MsgpackReader::text() noexcept { return next_of(Kind::text, &Head::content); }

std::optional<bool> MsgpackReader::boolean() noexcept {
    const std::optional<double> number = next_of(Kind::boolean, &Head::number);
    return number ? std::optional(*number != 0.0) : std::nullopt;
}

std::optional<std::uint32_t> MsgpackReader::begin_array() noexcept {
    return next_of(Kind::array, &Head::count);
}

std::optional<std::uint32_t> MsgpackReader::begin_map() noexcept { return next_of(Kind::map, &Head::count); }

} // namespace overt
