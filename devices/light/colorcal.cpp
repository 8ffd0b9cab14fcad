#include "devices/light/colorcal.h"

#include <algorithm>

#include <fmt/format.h>

#include "devices/display_box/bits_protocol.h"
#include "devices/link/text_line.h"
#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

/// Longer than any answer; what goes beyond is no answer.
constexpr std::size_t longest_answer = 1024;

std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields;
    while (true) {
        const std::size_t comma = line.find(',');
        std::string_view field = line.substr(0, comma);
        while (!field.empty() && field.front() == ' ')
            field.remove_prefix(1);
        while (!field.empty() && field.back() == ' ')
            field.remove_suffix(1);
        fields.emplace_back(field);
        if (comma == std::string_view::npos)
            return fields;
        line.remove_prefix(comma + 1);
    }
}

/// The first whole line that is an answer: "OK" or "ER" and two digits at its head, maybe behind the prompt
/// of the answer before.
std::optional<std::string_view> answer_in(std::string_view text) {
    while (true) {
        const std::size_t end = text.find_first_of("\r\n");
        if (end == std::string_view::npos)
            return std::nullopt;
        std::string_view line = text.substr(0, end);
        while (!line.empty() && (line.front() == '>' || line.front() == ' ' || line.front() == '\0'))
            line.remove_prefix(1);
        const auto digit = [&line](std::size_t i) { return line[i] >= '0' && line[i] <= '9'; };
        if (line.size() >= 4 && (line.starts_with("OK") || line.starts_with("ER")) && digit(2) && digit(3))
            return line;
        text.remove_prefix(end + 1);
    }
}

/// Three numbers, which stand behind the code of an answer; nothing if it has others.
template <class Parse>
std::optional<glm::dvec3> three_numbers(const std::vector<std::string>& fields, Parse parse) {
    if (fields.size() != 4)
        return std::nullopt;
    glm::dvec3 numbers(0.0);
    for (int i = 0; i < 3; ++i) {
        const std::optional<double> number = parse(fields[static_cast<std::size_t>(i) + 1]);
        if (!number)
            return std::nullopt;
        numbers[i] = *number;
    }
    return numbers;
}

std::string meaning_of(std::string_view code) {
    return code == "ER11" ? "the photometer sees light: cover its lens and try again"
                          : "plug the photometer out and in and try again";
}

} // namespace

std::optional<double> colorcal_matrix_entry(std::string_view text) {
    const auto n = number_in<int>(text);
    if (!n || *n < 0 || *n > 99999)
        return std::nullopt;
    return (*n < 50000 ? *n : 50000 - *n) / 10000.0;
}

ColorCal::ColorCal(std::unique_ptr<ByteTransport> transport, Clock& clock, ColorCalTimeouts timeouts)
    : transport_(std::move(transport)), clock_(clock), timeouts_(timeouts) {
    const auto fields = ask("IDR", timeouts_.reply);
    const auto build = number_in<int>(fields.back());
    if (fields.size() < 6 || !build)
        throw DeviceError(fmt::format("{}: \"IDR\" was answered with {} fields of which the last is \"{}\" "
                                      "and not a build number; this "
                                      "is no ColorCAL MkII.",
                                      transport_->name(), fields.size(), printable(fields.back())));
    identity_ = {transport_->name(), fields[2], fields[4], *build};
    for (int row = 0; row < 3; ++row) {
        const glm::dvec3 entries = ask_matrix_row(row);
        for (int column = 0; column < 3; ++column)
            xyz_from_raw_[column][row] = entries[column]; // glm's first index is the column
    }
}

void ColorCal::send(std::string_view command) {
    // What is still here belongs to the answer before: its prompt, or a late one.
    read_away(*transport_, SessionTime());
    if (!transport_->write(fmt::format("{}\n", command), clock_.now() + timeouts_.reply))
        throw DeviceError(fmt::format("{}: the photometer did not take \"{}\" ({}); plug it out and in.",
                                      transport_->name(), command,
                                      transport_->lost() ? transport_->loss() : "it is busy"));
}

std::vector<std::string> ColorCal::ask(std::string_view command, SessionDuration timeout) {
    send(command);
    const SessionTime deadline = clock_.now() + timeout;
    std::string text;
    std::array<char, 256> bytes{};
    while (clock_.now() < deadline && text.size() < longest_answer) {
        const std::size_t count = transport_->read(bytes, deadline);
        text.append(bytes.data(), count);
        if (const auto answer = answer_in(text)) {
            auto fields = fields_of(*answer);
            if (fields.front() == "OK00")
                return fields;
            throw DeviceError(fmt::format("{}: \"{}\" was answered with {}: {}.", transport_->name(), command,
                                          printable(*answer), meaning_of(fields.front())));
        }
        if (transport_->lost())
            throw DeviceError(fmt::format(
                "{}: the line to the photometer was lost at \"{}\" ({}); plug it in and start again.",
                transport_->name(), command, transport_->loss()));
    }
    throw DeviceError(fmt::format(
        "{}: no answer to \"{}\" came within {:.1f} s, but {}; see that this is the photometer's port.",
        transport_->name(), command, to_seconds(timeout),
        text.empty() ? "nothing" : fmt::format("\"{}\"", printable(text))));
}

glm::dvec3 ColorCal::ask_matrix_row(int row) {
    const std::string command = fmt::format("r0{}", row + 1);
    const auto entries = three_numbers(ask(command, timeouts_.reply), colorcal_matrix_entry);
    if (!entries)
        throw DeviceError(fmt::format(
            "{}: \"{}\" was not answered with three integers from 0 to 99999; plug the photometer out and "
            "in and try again.",
            transport_->name(), command));
    return *entries;
}

void ColorCal::calibrate_dark() { ask("UZC", timeouts_.dark_calibration); }

glm::dvec3 ColorCal::measure_xyz() {
    const auto raw = three_numbers(ask("MES", timeouts_.measurement), decimal_number);
    if (!raw)
        throw DeviceError(fmt::format("{}: \"MES\" was not answered with three numbers; measure again.",
                                      transport_->name()));
    return xyz_from_raw_ * *raw;
}

std::unique_ptr<ColorCal> find_colorcal(std::span<const SerialPortInfo> candidates,
                                        const std::optional<std::string>& port, const TransportOpener& open,
                                        Clock& clock, ColorCalTimeouts timeouts) {
    if (port)
        return std::make_unique<ColorCal>(open(*port), clock, timeouts);
    std::vector<std::string> found;
    for (const SerialPortInfo& candidate : candidates)
        if (candidate.vendor_id == crs_vendor_id && candidate.product_id == colorcal_product_id)
            found.push_back(candidate.path);
    if (found.size() == 1)
        return std::make_unique<ColorCal>(open(found.front()), clock, timeouts);
    if (found.empty())
        throw DeviceError(fmt::format("no ColorCAL is among the {} USB serial ports (its numbers are "
                                      "{:04x}:{:04x}); plug it in or name "
                                      "its port.",
                                      candidates.size(), crs_vendor_id, colorcal_product_id));
    throw DeviceError(
        fmt::format("{} ColorCALs are plugged in, among them {} and {}; name the port of the one to use.",
                    found.size(), found[0], found[1]));
}

} // namespace overt
