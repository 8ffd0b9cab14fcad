/// The report descriptor of a HID device: what each bit of its reports means. After the Device Class
/// Definition for HID 1.11 (USB Implementers' Forum), section 6.2.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace overt {

/// A meaning that the HID Usage Tables give a number to: page and number within it.
struct HidUsage {
    std::uint16_t page = 0;
    std::uint16_t id = 0;
    friend constexpr auto operator<=>(const HidUsage&, const HidUsage&) = default;
};

enum class HidReportKind : std::uint8_t { input, output, feature };

/// A group of fields, and of groups. An X within "gaze point" is another than one within "left eye".
struct HidCollection {
    HidUsage usage;
    std::uint8_t type = 0;     ///< 1: application, 0: physical, 2: logical …
    std::optional<int> parent; ///< index into the collections; none: it is an outermost one
};

/// Some bits of a report that are one number. A variable has one usage. An element of an array holds the
/// number of one usage out of a range, such as a key that is down.
struct HidField {
    HidReportKind kind = HidReportKind::input;
    std::uint8_t report_id = 0;   ///< 0: the device has no report ids
    std::uint32_t bit_offset = 0; ///< from the report's first byte, which is the id where there are ids
    std::uint8_t bit_size = 0;    ///< 1 to 64
    bool is_constant = false, is_array = false, is_relative = false;
    HidUsage usage;      ///< of an array: of the value logical_minimum
    HidUsage last_usage; ///< of an array: the highest; else as `usage`
    std::optional<int> collection;
    std::int64_t logical_minimum = 0, logical_maximum = 0;
    std::int64_t physical_minimum = 0, physical_maximum = 0; ///< both 0: none are given
    int unit_exponent = 0;                                   ///< power of ten, -8 to 7
    std::uint32_t unit = 0;                                  ///< one nibble a base unit; 0x11 is a centimetre
};

struct HidReport {
    HidReportKind kind = HidReportKind::input;
    std::uint8_t id = 0;
    std::size_t bytes = 0; ///< with the id's byte, if there are ids
};

struct HidDescriptor {
    std::vector<HidCollection> collections;
    std::vector<HidField> fields; ///< as they stand in the descriptor
    std::vector<HidReport> reports;
    bool has_report_ids = false;

    /// Whether a field lies in a collection of this usage, directly or in one within it.
    bool is_within(const HidField& field, HidUsage collection) const noexcept;

    /// Bytes of a report with its id byte if the device has ids; 0 if there is none such.
    std::size_t report_bytes(HidReportKind kind, std::uint8_t report_id) const noexcept;

    /// Bytes of the longest report of the kind.
    std::size_t longest_report_bytes(HidReportKind kind) const noexcept;
};

/// Longest descriptor that Linux takes (HID_MAX_DESCRIPTOR_SIZE).
inline constexpr std::size_t most_descriptor_bytes = 4096;

/// Throws DeviceError, naming the byte, for what cannot be told apart into reports: cut off items, unbalanced
/// collections, fields of more than 64 bits that are not padding, reports of more than 16 KiB. Constant
/// fields without a usage (padding) take room and are left out.
HidDescriptor parse_report_descriptor(std::span<const std::byte> bytes);

/// The number that a field has in a report as it was read, id byte included; signed where the field's logical
/// minimum is negative. Nothing if the report is too short. 64 bits without a sign come as the same bits.
std::optional<std::int64_t> hid_value(const HidField& field, std::span<const std::byte> report) noexcept;

/// Writes a number into a report that is long enough; what is too large loses its upper bits.
void put_hid_value(const HidField& field, std::int64_t value, std::span<std::byte> report) noexcept;

/// In the field's unit: from the logical to the physical range, times the power of ten. Nothing for a value
/// outside the logical range, by which devices say that they have none (HID 1.11, null values).
std::optional<double> hid_physical(const HidField& field, std::int64_t value) noexcept;

/// As hid_physical, in millimetres; nothing also if the field's unit is no length.
std::optional<double> hid_millimetres(const HidField& field, std::int64_t value) noexcept;

/// Whether the field's unit is a length: centimetres or inches.
bool is_length(const HidField& field) noexcept;

} // namespace overt
