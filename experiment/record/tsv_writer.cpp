#include "experiment/record/tsv_writer.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/error.h"

namespace overt {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;
constexpr std::array<std::int64_t, 10> powers_of_ten{
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

void append_integer(std::string& text, std::uint64_t number) {
    std::array<char, 20> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text.append(digits.data(), end);
}

/// A whole number of 10^-decimals.
void append_scaled(std::string& text, std::int64_t number, int decimals) {
    if (number < 0)
        text += '-';
    const std::uint64_t magnitude = number < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(number)
                                               : static_cast<std::uint64_t>(number);
    const auto scale = static_cast<std::uint64_t>(powers_of_ten[static_cast<std::size_t>(decimals)]);
    append_integer(text, magnitude / scale);
    if (decimals == 0)
        return;
    text += '.';
    std::array<char, 9> digits;
    std::uint64_t rest = magnitude % scale;
    for (int i = decimals - 1; i >= 0; --i, rest /= 10)
        digits[static_cast<std::size_t>(i)] = static_cast<char>('0' + rest % 10);
    text.append(digits.data(), static_cast<std::size_t>(decimals));
}

} // namespace

std::string tsv_cell(std::string_view text) {
    if (text.empty())
        return "n/a";
    std::string cell;
    for (const char c : text) {
        switch (c) {
        case '\t':
            cell += "\\t";
            break;
        case '\n':
            cell += "\\n";
            break;
        case '\r':
            cell += "\\r";
            break;
        case '\\':
            cell += "\\\\";
            break;
        default:
            cell += c;
        }
    }
    return cell;
}

TsvWriter::TsvWriter(const std::filesystem::path& directory, const TsvTable& table)
    : file_(directory / table.file),
      descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)),
      columns_(static_cast<int>(table.columns.size())) {
    if (descriptor_ < 0)
        throw RecordError(fmt::format("{}: cannot be made: {}. Check the folder's permissions.",
                                      file_.string(), std::strerror(errno)));
    buffer_.reserve(buffer_bytes + 4096);
    for (const TsvColumn& column : table.columns)
        ready(column.name);
    end_row();
    rows_ = 0;
}

TsvWriter::~TsvWriter() {
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

void TsvWriter::begin_cell() {
    if (cells_++ > 0)
        buffer_ += '\t';
}

TsvWriter& TsvWriter::text(std::string_view text) { return ready(tsv_cell(text)); }

TsvWriter& TsvWriter::ready(std::string_view text, int cells) {
    begin_cell();
    buffer_ += text;
    cells_ += cells - 1;
    return *this;
}

TsvWriter& TsvWriter::integer(std::int64_t number) {
    begin_cell();
    append_scaled(buffer_, number, 0);
    return *this;
}

TsvWriter& TsvWriter::fixed(double number, int decimals) {
    constexpr double largest_exact = 9.0e15; // below 2^53: all whole numbers up to here are doubles
    const double scaled = number * static_cast<double>(powers_of_ten[static_cast<std::size_t>(decimals)]);
    if (!std::isfinite(number))
        return missing();
    begin_cell();
    if (std::abs(scaled) < largest_exact)
        append_scaled(buffer_, std::llround(scaled), decimals);
    else
        fmt::format_to(std::back_inserter(buffer_), "{:.{}f}", number, decimals);
    return *this;
}

TsvWriter& TsvWriter::seconds(SessionDuration duration) {
    begin_cell();
    append_scaled(buffer_, duration.count(), 9);
    return *this;
}

TsvWriter& TsvWriter::missing(int cells) {
    for (int i = 0; i < cells; ++i)
        ready("n/a");
    return *this;
}

void TsvWriter::end_row() {
    OVERT_EXPECTS(cells_ == columns_);
    buffer_ += '\n';
    cells_ = 0;
    ++rows_;
    if (buffer_.size() >= buffer_bytes)
        write_buffer();
}

void TsvWriter::write_buffer() {
    std::size_t written = 0;
    while (written < buffer_.size()) {
        const auto count = ::write(descriptor_, buffer_.data() + written, buffer_.size() - written);
        if (count < 0 && errno != EINTR)
            throw RecordError(fmt::format("{}: writing failed: {}. Check the disk's space.", file_.string(),
                                          std::strerror(errno)));
        if (count > 0)
            written += static_cast<std::size_t>(count);
    }
    buffer_.clear();
}

void TsvWriter::close() {
    write_buffer();
    ::close(descriptor_);
    descriptor_ = -1;
}

} // namespace overt
