#include "experiment/scene/files/ply_values.h"

#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace overt {
namespace {

// What a row needs at least: every list empty.
std::uint64_t least_row_bytes(const PlyElement& element) {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        bytes += size_of(property.count_type.value_or(property.type));
    }
    return bytes;
}

std::string too_short(const PlyElement& element, std::uint64_t remaining) {
    return fmt::format(
        "the header promises {} {} elements, but the {} bytes that follow are too few for them. The "
        "file is cut off or its header is damaged; copy or export it again.",
        element.count, element.name, remaining);
}

std::string cut_off(const PlyElement& element, std::uint64_t row) {
    return fmt::format(
        "the file ends inside {} {} (counted from 0): the header promises {} of them, {} are complete. "
        "Copy or export the file again.",
        element.name, row, element.count, row);
}

// nullopt unless the number is integral; beyond 64 bits it becomes the largest or smallest.
std::optional<std::int64_t> integral(double value) {
    if (std::isnan(value) || std::trunc(value) != value)
        return std::nullopt;
    if (value >= 9223372036854775808.0)
        return std::numeric_limits<std::int64_t>::max();
    if (value < -9223372036854775808.0)
        return std::numeric_limits<std::int64_t>::min();
    return static_cast<std::int64_t>(value);
}

constexpr std::string_view trailing = "the file goes on after the last element that its header promises; "
                                      "header and content do not belong together.";

} // namespace

PlyText::PlyText(const MeshSource& source, const PlyHeader& header)
    : text_(source, header.body_offset, header.body_line) {}

void PlyText::begin_element(const PlyElement& element) {
    element_ = &element;
    // A value takes a character and the blank or line end behind it, which the last may lack.
    const std::uint64_t least_bytes = 2 * element.properties.size();
    const std::uint64_t remaining = text_.remaining_bytes();
    if (least_bytes > 0 && element.count > (remaining + 1) / least_bytes) {
        text_.next_in_line();
        text_.fail(too_short(element, remaining));
    }
}

void PlyText::begin_row(std::uint64_t row) {
    row_ = row;
    row_begins_ = true;
    broken_at_.reset();
}

std::string_view PlyText::next_word() {
    std::string_view word = row_begins_ ? text_.next() : text_.next_in_line();
    if (word.empty() && text_.remaining_bytes() == 0)
        text_.fail(cut_off(*element_, row_));
    if (word.empty()) {
        if (!broken_at_)
            broken_at_ = text_.place();
        word = text_.next();
        if (word.empty())
            fail_lacking(*broken_at_);
    }
    row_begins_ = false;
    return word;
}

void PlyText::fail_lacking(TextPlace place) const {
    text_.source().fail_at(
        place.line, place.column,
        fmt::format("the line of {} {} (counted from 0) lacks a value.", element_->name, row_));
}

double PlyText::coordinate(PlyType, char axis) {
    const std::string_view word = next_word();
    const std::optional<double> value = MeshText::number_in(word);
    if (!value) {
        text_.fail(fmt::format("{} of vertex {} (counted from 0) is {}, which is no number.", axis, row_,
                               MeshText::quoted(word)));
    }
    return *value;
}

std::int64_t PlyText::integer(PlyType) {
    const std::string_view word = next_word();
    if (const auto value = MeshText::integer_in(word))
        return *value;
    if (const auto number = MeshText::number_in(word)) {
        if (const auto value = integral(*number))
            return *value;
    }
    text_.fail(fmt::format("{} in {} {} (counted from 0) is no integer.", MeshText::quoted(word),
                           element_->name, row_));
}

void PlyText::skip(PlyType, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i)
        next_word();
}

void PlyText::end_row() {
    if (const std::string_view word = text_.next_in_line(); !word.empty()) {
        // A row that goes on in the next line takes that line whole, or it lacks a value itself.
        if (broken_at_)
            fail_lacking(*broken_at_);
        text_.fail(fmt::format(
            "the line of {} {} (counted from 0) goes on with {}; the header promises fewer values.",
            element_->name, row_, MeshText::quoted(word)));
    }
}

void PlyText::end() {
    if (is_padding(text_.source().bytes().substr(text_.offset())))
        return;
    text_.next();
    text_.fail(trailing);
}

PlyBinary::PlyBinary(const MeshSource& source, const PlyHeader& header)
    : source_(source), at_(source.bytes().data() + header.body_offset),
      end_(source.bytes().data() + source.bytes().size()), last_(at_),
      order_(header.format == PlyFormat::big_endian ? std::endian::big : std::endian::little) {}

void PlyBinary::begin_element(const PlyElement& element) {
    element_ = &element;
    const std::uint64_t least_bytes = least_row_bytes(element);
    if (least_bytes > 0 && element.count > remaining() / least_bytes) {
        last_ = at_;
        fail(too_short(element, remaining()));
    }
}

const char* PlyBinary::take(std::uint64_t size) {
    last_ = at_;
    if (size > remaining()) {
        last_ = end_;
        fail(cut_off(*element_, row_));
    }
    at_ += size;
    return last_;
}

double PlyBinary::coordinate(PlyType type, char) {
    if (type == PlyType::float32)
        return static_cast<double>(stored_value<float>(take(4), order_));
    if (type == PlyType::float64)
        return stored_value<double>(take(8), order_);
    return static_cast<double>(integer(type));
}

std::int64_t PlyBinary::integer(PlyType type) {
    const char* bytes = take(size_of(type));
    double real = 0.0;
    switch (type) {
    case PlyType::int8:
        return stored_value<std::int8_t>(bytes, order_);
    case PlyType::uint8:
        return stored_value<std::uint8_t>(bytes, order_);
    case PlyType::int16:
        return stored_value<std::int16_t>(bytes, order_);
    case PlyType::uint16:
        return stored_value<std::uint16_t>(bytes, order_);
    case PlyType::int32:
        return stored_value<std::int32_t>(bytes, order_);
    case PlyType::uint32:
        return stored_value<std::uint32_t>(bytes, order_);
    case PlyType::int64:
        return stored_value<std::int64_t>(bytes, order_);
    case PlyType::uint64:
        return integral(static_cast<double>(stored_value<std::uint64_t>(bytes, order_))).value();
    case PlyType::float32:
        real = static_cast<double>(stored_value<float>(bytes, order_));
        break;
    case PlyType::float64:
        real = stored_value<double>(bytes, order_);
        break;
    }
    if (const auto value = integral(real))
        return *value;
    fail(fmt::format("{} in {} {} (counted from 0) is no integer.", real, element_->name, row_));
}

void PlyBinary::skip(PlyType type, std::int64_t count) {
    const auto values = static_cast<std::uint64_t>(count);
    if (values > room_for(type))
        take(remaining() + 1);
    take(values * size_of(type));
}

void PlyBinary::end() {
    last_ = at_;
    if (!is_padding({at_, static_cast<std::size_t>(remaining())}))
        fail(trailing);
}

void PlyBinary::fail(std::string_view message) const {
    source_.fail_at_byte(static_cast<std::size_t>(last_ - source_.bytes().data()), message);
}

} // namespace overt
