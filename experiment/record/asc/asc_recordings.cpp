#include "experiment/record/asc/asc_recordings.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "experiment/record/asc/asc_words.h"

namespace overt {

void AscRecordings::need_setup(TrackerTime at) {
    if (!has_setup_)
        message(at, fmt::format("RECCFG CR {:.0f} 2 1 {}", layout().rate_hz, layout().eyes()));
    if (!has_mount_)
        message(at, layout().eyes() == "LR" ? "ELCLCFG BTABLER" : "ELCLCFG MTABLER");
}

void AscRecordings::message(TrackerTime at, std::string_view text) {
    const std::string_view word = Words(text).next();
    if (word == "GAZE_COORDS") {
        if (!has_setup_)
            need_setup(at);
        has_coordinates_ = true;
    }
    has_setup_ |= word == "RECCFG";
    has_mount_ |= word == "ELCLCFG";
    writer_.message(at, text);
}

void AscRecordings::start(TrackerTime at, std::string_view text, std::span<const GazeSample> next) {
    if (is_open_)
        end(last_sample_ ? std::min(at, after_last_sample()) : at, {});
    AscStart start = asc_start(text, layout());
    if (text.empty())
        start.tracking = tracking_;
    tracking_ = start.tracking;
    for (const GazeSample& sample : next)
        (sample.eye == Eye::left ? start.left : start.right) = true;
    writer_.set_eyes(start);
    if (!has_setup_)
        need_setup(at);
    if (!has_coordinates_)
        message(at, fmt::format("GAZE_COORDS 0.00 0.00 {}.00 {}.00", screen_px_.x - 1, screen_px_.y - 1));
    writer_.start(at, start);
    is_open_ = true;
    started_ = at;
    last_sample_.reset();
}

void AscRecordings::end(TrackerTime at, std::string_view resolution) {
    if (!is_open_)
        return;
    writer_.end(at, resolution);
    is_open_ = false;
}

void AscRecordings::samples(std::span<const GazeSample> instant) {
    if (!is_open_)
        start(instant.front().sampled_at, {}, instant);
    last_sample_ = instant.front().sampled_at;
    writer_.samples(instant);
}

void AscRecordings::finish() {
    if (is_open_)
        end(last_sample_ ? after_last_sample() : started_, {});
}

TrackerTime AscRecordings::after_last_sample() const {
    return *last_sample_ + TrackerClock::duration(static_cast<std::int64_t>(1e6 / layout().rate_hz));
}

} // namespace overt
