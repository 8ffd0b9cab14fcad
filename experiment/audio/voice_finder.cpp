#include "experiment/audio/voice_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>

namespace overt {

namespace {

constexpr double high_pass_hz = 80.0;
constexpr int window = 10, shortest_voice = 50, soonest_voice = 150; ///< milliseconds
constexpr double low_db = 4.0, high_db = 9.0, refine_db = 6.0, least_dbfs = -65.0;
constexpr float full_scale = 0.9999f;
constexpr double quietest_db = -144.0; ///< a step of 24 bits

double decibels(double mean_square) {
    return mean_square > 0.0 ? std::max(quietest_db, 10.0 * std::log10(mean_square)) : quietest_db;
}
double power(double db) { return std::pow(10.0, 0.1 * db); }

} // namespace

VoiceFinder::VoiceFinder(double rate_hz)
    : rate_hz_(rate_hz), block_(std::max(1, static_cast<int>(std::lround(1e-3 * rate_hz)))),
      pole_(std::exp(-2.0 * std::numbers::pi * high_pass_hz / rate_hz)) {}

void VoiceFinder::add(std::span<const float> samples) {
    for (const float sample : samples) {
        peak_ = std::max(peak_, std::abs(sample));
        if (std::abs(sample) >= full_scale) {
            const int sign = sample > 0.0f ? 1 : -1;
            run_ = run_ * sign > 0 ? run_ + sign : sign;
            // With its second the run counts, and its first with it.
            clipped_ += std::abs(run_) == 2 ? 2 : std::abs(run_) > 2 ? 1 : 0;
        } else {
            run_ = 0;
        }
        const auto in = static_cast<double>(sample);
        const double first = pole_ * first_out_ + in - last_in_;
        second_out_ = pole_ * second_out_ + first - first_out_;
        first_out_ = first;
        last_in_ = in;
        sum_ += second_out_ * second_out_;
        if (++in_block_ == block_) {
            energies_.push_back(static_cast<float>(sum_ / block_));
            sum_ = 0.0;
            in_block_ = 0;
        }
    }
}

std::vector<float> VoiceFinder::windows() const {
    std::vector<float> means;
    double sum = 0.0;
    for (std::size_t i = 0; i < energies_.size(); ++i) {
        sum += static_cast<double>(energies_[i]);
        if (i >= window)
            sum -= static_cast<double>(energies_[i - window]);
        if (i + 1 >= window)
            means.push_back(static_cast<float>(std::max(0.0, sum / window)));
    }
    return means;
}

double VoiceFinder::floor_of(const std::vector<float>& windows) {
    if (windows.empty())
        return 0.0;
    const auto quantile = [](std::vector<float> of, std::size_t one_in) {
        const auto at = of.begin() + static_cast<std::ptrdiff_t>(of.size() / one_in);
        std::nth_element(of.begin(), at, of.end());
        return static_cast<double>(*at);
    };
    const auto head = windows.begin() + std::min<std::ptrdiff_t>(std::ssize(windows), soonest_voice);
    return std::min(quantile(windows, 5), quantile({windows.begin(), head}, 2));
}

std::optional<VoiceSpan> VoiceFinder::voice() const {
    const std::vector<float> levels = windows();
    const double floor = floor_of(levels);
    const double low = floor * power(low_db), high = std::max(floor * power(high_db), power(least_dbfs));
    std::optional<VoiceSpan> voice;
    for (std::size_t begin = 0; begin < levels.size(); ++begin) {
        if (static_cast<double>(levels[begin]) <= low)
            continue;
        std::size_t end = begin;
        double loudest = 0.0;
        for (; end < levels.size() && static_cast<double>(levels[end]) > low; ++end)
            loudest = std::max(loudest, static_cast<double>(levels[end]));
        if (loudest >= high && end - begin >= shortest_voice) {
            if (!voice) {
                // The first window has noise in front of the voice.
                std::size_t first = begin;
                const auto is_loud = [&](std::size_t at) {
                    return at < energies_.size() &&
                           static_cast<double>(energies_[at]) > floor * power(refine_db);
                };
                while (first < begin + window &&
                       !(is_loud(first) && is_loud(first + 1) && is_loud(first + 2)))
                    ++first;
                voice = VoiceSpan{static_cast<double>(first) * block_, 0.0};
            }
            voice->end = static_cast<double>(end) * block_;
        }
        begin = end;
    }
    return voice;
}

double VoiceFinder::noise_dbfs() const { return decibels(floor_of(windows())); }

double VoiceFinder::peak_dbfs() const {
    return decibels(static_cast<double>(peak_) * static_cast<double>(peak_));
}

} // namespace overt
