#include "devices/display_box/bits_status.h"

#include <cmath>

#include "devices/display_box/bits_protocol.h"
#include "devices/link/text_line.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

/// Takes a line's fields one after the other; once one is not what it should be, all that follow are refused.
class FieldReader {
  public:
    explicit FieldReader(std::string_view text) : rest_(text) {}

    std::string_view next() {
        const std::size_t end = rest_.find(';');
        if (end == std::string_view::npos) { // each field of a whole line is followed by a semicolon
            good_ = false;
            return {};
        }
        const std::string_view field = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return field;
    }

    std::uint64_t count() {
        const auto value = number_in<std::uint64_t>(next());
        good_ = good_ && value;
        return value.value_or(0);
    }

    bool level() {
        const std::string_view field = next();
        good_ = good_ && (field == "0" || field == "1");
        return field == "1";
    }

    double number(double largest) {
        const std::optional<double> value = decimal_number(next());
        good_ = good_ && value && std::abs(*value) <= largest;
        return good_ ? *value : 0.0;
    }

    bool ended_well() const { return good_ && rest_.empty(); }

  private:
    std::string_view rest_;
    bool good_ = true;
};

/// Over 30 years; the clock holds more.
constexpr double latest_s = 1e9;

/// Any level beyond is no reading: the inputs take ±5 V.
constexpr double largest_v = 1000.0;

} // namespace

std::optional<StatusSample> parse_status_line(std::string_view line) {
    const auto text = bits_reply(line, "sample");
    if (!text)
        return std::nullopt;
    FieldReader fields(*text);
    StatusSample sample;
    sample.number = fields.count();
    const double time_s = fields.number(latest_s);
    if (time_s < 0.0)
        return std::nullopt;
    sample.at = BoxTime(BoxClock::duration(std::llround(time_s * 1e6)));
    sample.trigger = fields.level();
    for (std::size_t i = 0; i < sample.digital.size(); ++i)
        sample.digital[i] = fields.level();
    for (std::size_t i = 0; i < sample.infrared.size(); ++i)
        sample.infrared[i] = fields.level();
    for (float& volts : sample.analogue_v)
        volts = static_cast<float>(fields.number(largest_v));
    return fields.ended_well() ? std::optional(sample) : std::nullopt;
}

bool is_touch_line(std::string_view line) { return line.find("$touch;") != std::string_view::npos; }

void BoxEdgeDetector::add(const StatusSample& sample, BoxInput input, bool active,
                          float analogue_v) noexcept {
    events_[count_++] = {sample.at, last_->at, input, active, analogue_v};
}

std::span<const BoxEvent> BoxEdgeDetector::feed(const StatusSample& sample) noexcept {
    using Kind = BoxInput::Kind;
    count_ = 0;
    if (!last_) {
        reported_v_ = sample.analogue_v;
        last_ = sample;
        return {};
    }
    if (sample.trigger != last_->trigger)
        add(sample, {Kind::trigger, 0}, sample.trigger, 0.0f);
    for (std::size_t i = 0; i < sample.digital.size(); ++i)
        if (sample.digital[i] != last_->digital[i])
            add(sample, {Kind::digital, static_cast<std::uint8_t>(i)}, !sample.digital[i], 0.0f);
    for (std::size_t i = 0; i < sample.infrared.size(); ++i)
        if (sample.infrared[i] != last_->infrared[i])
            add(sample, {Kind::infrared, static_cast<std::uint8_t>(i)}, !sample.infrared[i], 0.0f);
    for (std::size_t i = 0; threshold_v_ && i < sample.analogue_v.size(); ++i) {
        if (std::abs(sample.analogue_v[i] - reported_v_[i]) < *threshold_v_)
            continue;
        reported_v_[i] = sample.analogue_v[i];
        add(sample, {Kind::analogue, static_cast<std::uint8_t>(i)}, false, sample.analogue_v[i]);
    }
    last_ = sample;
    return {events_.data(), count_};
}

} // namespace overt
