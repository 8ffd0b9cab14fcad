#include "devices/hid/report_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

// What Linux takes, or more than any device has: a hostile descriptor of 4 KiB can otherwise ask for any
// amount of memory.
constexpr std::uint32_t most_report_bits = 8 * 16384;
constexpr std::size_t most_fields = 12288, deepest = 64;

/// Globals of HID 1.11, section 6.2.2.7. Extents are kept as they stand, with the sign and without: which of
/// them was meant is known when both ends are.
struct Extent {
    std::int64_t with_sign = 0, without_sign = 0;
};
struct Globals {
    std::uint16_t page = 0;
    Extent logical_minimum, logical_maximum, physical_minimum, physical_maximum;
    int unit_exponent = 0;
    std::uint32_t unit = 0, report_size = 0, report_count = 0;
    std::uint8_t report_id = 0;
};

struct UsageRange {
    std::uint32_t first = 0, last = 0;
    bool has_page = false; ///< in the upper half of both
};

/// Ends of a range: signed if the lower one is negative, else the upper one without a sign where it would be
/// below the lower one with it. Many descriptors give 255 as one byte.
std::pair<std::int64_t, std::int64_t> extent(const Extent& minimum, const Extent& maximum) {
    const std::int64_t low = minimum.with_sign;
    return {low, maximum.with_sign < low ? maximum.without_sign : maximum.with_sign};
}

class DescriptorParser {
  public:
    explicit DescriptorParser(std::span<const std::byte> bytes) : bytes_(bytes) {}

    HidDescriptor parse() {
        if (bytes_.size() > most_descriptor_bytes)
            refuse(fmt::format("it has {} bytes, and {} are the most there can be", bytes_.size(),
                               most_descriptor_bytes));
        while (at_ < bytes_.size())
            take_item();
        if (open_)
            refuse("a collection is not ended");
        if (!stack_.empty())
            refuse("a push has no pop");
        for (const auto& [report, bits] : bits_)
            result_.reports.push_back({report.first, report.second, (bits + 7) / 8});
        return std::move(result_);
    }

  private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw DeviceError(
            fmt::format("The HID report descriptor cannot be read, byte {}: {}.", item_at_, what));
    }

    std::uint8_t byte() {
        if (at_ >= bytes_.size())
            refuse("the item is cut off");
        return std::to_integer<std::uint8_t>(bytes_[at_++]);
    }

    void take_item() {
        item_at_ = at_;
        const std::uint8_t prefix = byte();
        if (prefix == 0xFE) { // a long item; none is defined
            const std::uint8_t length = byte();
            byte();
            for (int i = 0; i < length; ++i)
                byte();
            return;
        }
        const int size = (prefix & 3) == 3 ? 4 : prefix & 3;
        std::uint32_t data = 0;
        for (int i = 0; i < size; ++i)
            data |= std::uint32_t{byte()} << (8 * i);
        switch ((prefix >> 2) & 3) {
        case 0:
            take_main(prefix & 0xFC, data);
            break;
        case 1:
            take_global(prefix & 0xFC, data, size);
            break;
        case 2:
            take_local(prefix & 0xFC, data, size);
            break;
        default: // reserved
            break;
        }
    }

    static Extent extent_of(std::uint32_t data, int size) {
        if (size == 1)
            return {static_cast<std::int8_t>(data), data};
        if (size == 2)
            return {static_cast<std::int16_t>(data), data};
        return {static_cast<std::int32_t>(data), data};
    }

    void take_global(int tag, std::uint32_t data, int size) {
        switch (tag) {
        case 0x04:
            globals_.page = static_cast<std::uint16_t>(data);
            break;
        case 0x14:
            globals_.logical_minimum = extent_of(data, size);
            break;
        case 0x24:
            globals_.logical_maximum = extent_of(data, size);
            break;
        case 0x34:
            globals_.physical_minimum = extent_of(data, size);
            break;
        case 0x44:
            globals_.physical_maximum = extent_of(data, size);
            break;
        case 0x54: {
            // A nibble with a sign; some devices give the whole byte with one.
            const int nibble = static_cast<int>(data & 0xF);
            globals_.unit_exponent = nibble >= 8 ? nibble - 16 : nibble;
            break;
        }
        case 0x64:
            globals_.unit = data;
            break;
        case 0x74:
            globals_.report_size = data;
            break;
        case 0x84:
            if (data == 0 || data > 255)
                refuse(fmt::format("{} is no report id", data));
            if (!result_.has_report_ids && !bits_.empty())
                refuse("some reports have an id and others have none");
            globals_.report_id = static_cast<std::uint8_t>(data);
            result_.has_report_ids = true;
            break;
        case 0x94:
            globals_.report_count = data;
            break;
        case 0xA4:
            if (stack_.size() >= deepest)
                refuse("too many pushes");
            stack_.push_back(globals_);
            break;
        case 0xB4:
            if (stack_.empty())
                refuse("a pop has no push");
            globals_ = stack_.back();
            stack_.pop_back();
            break;
        default:
            break;
        }
    }

    void take_local(int tag, std::uint32_t data, int size) {
        switch (tag) {
        case 0x08:
            usages_.push_back({data, data, size == 4});
            break;
        case 0x18:
            minimum_ = {data, size == 4};
            break;
        case 0x28:
            if (minimum_) {
                const UsageRange range{minimum_->first, data, minimum_->second};
                if (range.last < range.first)
                    refuse("a range of usages ends before it begins");
                usages_.push_back(range);
                minimum_.reset();
            }
            break;
        default: // designators, strings and delimiters say nothing of the bits
            break;
        }
    }

    /// A usage of two bytes takes the page that holds at the main item: so does Linux, since some devices
    /// give the page after the usages.
    HidUsage whole(std::uint32_t usage, bool has_page) const {
        return {has_page ? static_cast<std::uint16_t>(usage >> 16) : globals_.page,
                static_cast<std::uint16_t>(usage)};
    }

    /// The usage of the field of that number, from 0: if there are fewer usages than fields, the last goes
    /// on.
    HidUsage usage_of(std::uint32_t number) const {
        std::uint64_t left = number;
        for (const UsageRange& range : usages_) {
            const std::uint64_t count = std::uint64_t{range.last} - range.first + 1;
            if (left < count)
                return whole(range.first + static_cast<std::uint32_t>(left), range.has_page);
            left -= count;
        }
        return usages_.empty() ? HidUsage{} : whole(usages_.back().last, usages_.back().has_page);
    }

    void take_main(int tag, std::uint32_t data) {
        switch (tag) {
        case 0x80:
            add_fields(HidReportKind::input, data);
            break;
        case 0x90:
            add_fields(HidReportKind::output, data);
            break;
        case 0xB0:
            add_fields(HidReportKind::feature, data);
            break;
        case 0xA0:
            if (depth_ >= deepest)
                refuse("too many collections within each other");
            ++depth_;
            result_.collections.push_back({usage_of(0), static_cast<std::uint8_t>(data), open_});
            open_ = static_cast<int>(result_.collections.size()) - 1;
            break;
        case 0xC0:
            if (!open_)
                refuse("a collection ends that was not begun");
            open_ = result_.collections[static_cast<std::size_t>(*open_)].parent;
            --depth_;
            break;
        default:
            break;
        }
        usages_.clear();
        minimum_.reset();
    }

    void add_fields(HidReportKind kind, std::uint32_t flags) {
        const std::uint32_t size = globals_.report_size, count = globals_.report_count;
        std::uint32_t& bits =
            bits_.try_emplace({kind, globals_.report_id}, result_.has_report_ids ? 8u : 0u).first->second;
        if (std::uint64_t{size} * count > most_report_bits - bits)
            refuse(fmt::format("a report has more than {} bytes", most_report_bits / 8));
        const bool is_array = (flags & 2) == 0;
        // What is constant and means nothing fills a report up.
        if (size == 0 || ((flags & 1) != 0 && usages_.empty())) {
            bits += size * count;
            return;
        }
        if (size > 64)
            refuse(fmt::format("a field has {} bits, and 64 are the most that can be read", size));
        if (result_.fields.size() + count > most_fields)
            refuse(fmt::format("there are more than {} fields", most_fields));
        HidField field;
        field.kind = kind;
        field.report_id = globals_.report_id;
        field.bit_size = static_cast<std::uint8_t>(size);
        field.is_constant = (flags & 1) != 0;
        field.is_array = is_array;
        field.is_relative = (flags & 4) != 0;
        field.collection = open_;
        std::tie(field.logical_minimum, field.logical_maximum) =
            extent(globals_.logical_minimum, globals_.logical_maximum);
        std::tie(field.physical_minimum, field.physical_maximum) =
            extent(globals_.physical_minimum, globals_.physical_maximum);
        field.unit = globals_.unit;
        field.unit_exponent = globals_.unit_exponent;
        for (std::uint32_t i = 0; i < count; ++i, bits += size) {
            field.bit_offset = bits;
            field.usage = usage_of(is_array ? 0 : i);
            field.last_usage = field.usage;
            if (is_array && !usages_.empty())
                field.last_usage = whole(usages_.back().last, usages_.back().has_page);
            result_.fields.push_back(field);
        }
    }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0, item_at_ = 0, depth_ = 0;
    Globals globals_;
    std::vector<Globals> stack_;
    std::vector<UsageRange> usages_;
    std::optional<std::pair<std::uint32_t, bool>> minimum_;
    std::map<std::pair<HidReportKind, std::uint8_t>, std::uint32_t> bits_; ///< so far, of each report
    std::optional<int> open_;
    HidDescriptor result_;
};

/// Millimetres of the unit of length that HID 1.11, section 6.2.2.7 knows: a nibble for the system, the next
/// for the power of length. 0: it is none.
double millimetres_of(std::uint32_t unit) { return unit == 0x11 ? 10.0 : unit == 0x13 ? 25.4 : 0.0; }

} // namespace

HidDescriptor parse_report_descriptor(std::span<const std::byte> bytes) {
    return DescriptorParser(bytes).parse();
}

bool HidDescriptor::is_within(const HidField& field, HidUsage collection) const noexcept {
    for (std::optional<int> at = field.collection; at; at = collections[static_cast<std::size_t>(*at)].parent)
        if (collections[static_cast<std::size_t>(*at)].usage == collection)
            return true;
    return false;
}

std::size_t HidDescriptor::report_bytes(HidReportKind kind, std::uint8_t report_id) const noexcept {
    for (const HidReport& report : reports)
        if (report.kind == kind && report.id == report_id)
            return report.bytes;
    return 0;
}

std::size_t HidDescriptor::longest_report_bytes(HidReportKind kind) const noexcept {
    std::size_t longest = 0;
    for (const HidReport& report : reports)
        if (report.kind == kind)
            longest = std::max(longest, report.bytes);
    return longest;
}

std::optional<std::int64_t> hid_value(const HidField& field, std::span<const std::byte> report) noexcept {
    const std::size_t size = field.bit_size;
    if (size == 0 || field.bit_offset + size > 8 * report.size())
        return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t bit = 0; bit < size;) {
        const std::size_t at = field.bit_offset + bit, within = at % 8;
        const std::size_t count = std::min(8 - within, size - bit);
        const std::uint64_t part =
            (std::to_integer<std::uint64_t>(report[at / 8]) >> within) & ((1u << count) - 1u);
        value |= part << bit;
        bit += count;
    }
    if (field.logical_minimum < 0 && size < 64 && (value >> (size - 1)) != 0)
        value |= ~std::uint64_t{0} << size;
    return static_cast<std::int64_t>(value);
}

void put_hid_value(const HidField& field, std::int64_t value, std::span<std::byte> report) noexcept {
    for (std::size_t bit = 0; bit < field.bit_size; ++bit) {
        const std::size_t at = field.bit_offset + bit;
        if (at / 8 >= report.size())
            return;
        const std::byte mask{static_cast<unsigned char>(1u << (at % 8))};
        const bool is_set = ((static_cast<std::uint64_t>(value) >> bit) & 1u) != 0;
        report[at / 8] = is_set ? report[at / 8] | mask : report[at / 8] & ~mask;
    }
}

std::optional<double> hid_physical(const HidField& field, std::int64_t value) noexcept {
    const bool has_range = field.logical_maximum > field.logical_minimum;
    if (has_range && (value < field.logical_minimum || value > field.logical_maximum))
        return std::nullopt;
    auto physical = static_cast<double>(value);
    if (has_range && (field.physical_minimum != 0 || field.physical_maximum != 0)) {
        const double share = (physical - static_cast<double>(field.logical_minimum)) /
                             static_cast<double>(field.logical_maximum - field.logical_minimum);
        physical = static_cast<double>(field.physical_minimum) +
                   share * static_cast<double>(field.physical_maximum - field.physical_minimum);
    }
    return physical * std::pow(10.0, field.unit_exponent);
}

bool is_length(const HidField& field) noexcept { return millimetres_of(field.unit) != 0.0; }

std::optional<double> hid_millimetres(const HidField& field, std::int64_t value) noexcept {
    const std::optional<double> physical = hid_physical(field, value);
    if (!physical || !is_length(field))
        return std::nullopt;
    return *physical * millimetres_of(field.unit);
}

} // namespace overt
