#include "experiment/scene/files/mesh_text.h"

#include <charconv>
#include <cstring>
#include <limits>
#include <system_error>

#include <fmt/format.h>

namespace overt {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// std::from_chars knows no plus sign.
std::string_view without_plus(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+')
        word.remove_prefix(1);
    return word;
}

template <class Number> std::optional<Number> parsed(std::string_view word, std::errc& error) {
    Number value{};
    const auto [stop, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    error = code;
    if (code == std::errc::invalid_argument || stop != word.data() + word.size())
        return std::nullopt;
    return value;
}

} // namespace

MeshText::MeshText(const MeshSource& source, std::size_t from_byte, std::size_t line, LineJoining joining)
    : source_(source), at_(source.bytes().data() + from_byte),
      end_(source.bytes().data() + source.bytes().size()), line_begin_(at_), line_(line), place_{line, 1},
      joining_(joining) {}

std::size_t MeshText::offset() const { return static_cast<std::size_t>(at_ - source_.bytes().data()); }

std::size_t MeshText::joint_length() const {
    if (joining_ == LineJoining::none || *at_ != '\\')
        return 0;
    if (end_ - at_ >= 2 && at_[1] == '\n')
        return 2;
    if (end_ - at_ >= 3 && at_[1] == '\r' && at_[2] == '\n')
        return 3;
    return 0;
}

void MeshText::begin_line() {
    line_begin_ = at_;
    ++line_;
}

void MeshText::skip_blanks() {
    while (at_ < end_) {
        if (is_blank(*at_)) {
            ++at_;
        } else if (const std::size_t joint = joint_length(); joint > 0) {
            at_ += joint;
            begin_line();
        } else {
            break;
        }
    }
}

std::string_view MeshText::next_in_line() {
    skip_blanks();
    place_ = {line_, static_cast<std::size_t>(at_ - line_begin_) + 1};
    const char* const begin = at_;
    while (at_ < end_ && *at_ != '\n' && !is_blank(*at_) && joint_length() == 0)
        ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view MeshText::next() {
    while (true) {
        const std::string_view word = next_in_line();
        if (!word.empty() || at_ == end_)
            return word;
        to_next_line();
    }
}

std::string_view MeshText::rest_of_line() {
    if (at_ < end_ && is_blank(*at_) && *at_ != '\r')
        ++at_;
    place_ = {line_, static_cast<std::size_t>(at_ - line_begin_) + 1};
    const char* const begin = at_;
    const void* const line_end = std::memchr(at_, '\n', remaining_bytes());
    at_ = line_end ? static_cast<const char*>(line_end) : end_;
    std::string_view rest(begin, static_cast<std::size_t>(at_ - begin));
    if (!rest.empty() && rest.back() == '\r')
        rest.remove_suffix(1);
    return rest;
}

bool MeshText::to_next_line() {
    while (at_ < end_ && *at_ != '\n') {
        if (const std::size_t joint = joint_length(); joint > 0) {
            at_ += joint;
            begin_line();
        } else {
            ++at_;
        }
    }
    if (at_ == end_)
        return false;
    ++at_;
    begin_line();
    return true;
}

void MeshText::fail(std::string_view message) const { source_.fail_at(place_.line, place_.column, message); }

std::optional<double> MeshText::number_in(std::string_view word) {
    word = without_plus(word);
    std::errc error{};
    const std::optional<double> value = parsed<double>(word, error);
    if (error == std::errc::result_out_of_range) {
        // Beyond the type's range the exponent's sign tells too small from too large.
        const bool tiny =
            word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
        return tiny ? 0.0 : std::numeric_limits<double>::infinity();
    }
    if (!value &&
        (word.find(".#IND") != std::string_view::npos || word.find(".#INF") != std::string_view::npos ||
         word.find(".#QNAN") != std::string_view::npos || word.find(".#SNAN") != std::string_view::npos))
        return std::numeric_limits<double>::quiet_NaN();
    return value;
}

std::optional<std::int64_t> MeshText::integer_in(std::string_view word) {
    std::errc error{};
    const std::optional<std::int64_t> value = parsed<std::int64_t>(without_plus(word), error);
    return error == std::errc{} ? value : std::nullopt;
}

std::string MeshText::quoted(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text(word.substr(0, longest));
    for (char& c : text) {
        if (c < ' ' || c > '~')
            c = '?';
    }
    return fmt::format("'{}{}'", text, word.size() > longest ? "..." : "");
}

void MeshText::refuse_coordinate(char axis, std::string_view owner) const {
    if (last_.empty())
        fail(fmt::format("{} has no {} coordinate.", owner, axis));
    if (!number_in(last_))
        fail(fmt::format("{} of {} is {}, which is no number.", axis, owner, quoted(last_)));
    fail(fmt::format("{} of {} is {}; coordinates must be finite and fit a 32-bit float.", axis, owner,
                     quoted(last_)));
}

std::string MeshText::files_beside(std::span<const std::string> files) {
    std::string text = "Read beside it: ";
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < std::min(files.size(), most); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : ", ", files[i]);
    return text + (files.size() > most ? fmt::format(" and {} more.", files.size() - most) : ".");
}

} // namespace overt
