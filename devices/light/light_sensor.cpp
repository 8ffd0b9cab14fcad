#include "devices/light/light_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr SessionDuration listening = std::chrono::milliseconds(50);

/// When the change that ends this one's time begins: the next of its kind, or never.
std::optional<SessionTime> next_of_its_kind(std::span<const LightEdge> changes, std::size_t i) {
    for (std::size_t k = i + 1; k < changes.size(); ++k)
        if (changes[k].is_light == changes[i].is_light)
            return changes[k].at;
    return std::nullopt;
}

} // namespace

SimulatedLightSensor::SimulatedLightSensor(double latency_ms, double jitter_sd_ms, std::uint64_t seed)
    : latency_ms_(latency_ms), jitter_sd_ms_(jitter_sd_ms), random_(seed, "light sensor") {}

void SimulatedLightSensor::shown(const LightEdge& edge) {
    edges_.push_back(
        {edge.at + from_seconds(1e-3 * (latency_ms_ + jitter_sd_ms_ * random_.normal())), edge.is_light});
}

SerialLightSensor::SerialLightSensor(std::unique_ptr<ByteTransport> line, const Clock& clock)
    : line_(std::move(line)), clock_(&clock), listener_([this] { listen(); }) {}

SerialLightSensor::~SerialLightSensor() {
    ends_ = true;
    listener_.join();
}

void SerialLightSensor::listen() {
    std::array<char, 64> bytes;
    while (!ends_ && !line_->lost()) {
        const std::size_t count = line_->read(bytes, clock_->now() + listening);
        const SessionTime now = clock_->now();
        const std::lock_guard lock(mutex_);
        for (std::size_t i = 0; i < count; ++i)
            if (bytes[i] == '0' || bytes[i] == '1')
                edges_.push_back({now, bytes[i] == '1'});
        if (line_->lost())
            loss_ = fmt::format("{}: {}", line_->name(), line_->loss());
    }
}

std::vector<LightEdge> SerialLightSensor::edges() {
    const std::lock_guard lock(mutex_);
    if (!loss_.empty())
        throw DeviceError("the light sensor was lost: " + loss_);
    return edges_;
}

LightLatency compare_light(std::span<const LightEdge> changes, std::span<const LightEdge> edges,
                           double earliest_ms) {
    LightLatency found;
    std::vector<double>& delays_ms = found.delays_ms;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const SessionDuration earliest = from_seconds(1e-3 * earliest_ms);
        const SessionTime from = changes[i].at + earliest;
        const std::optional<SessionTime> next = next_of_its_kind(changes, i);
        const auto edge = std::ranges::find_if(edges, [&](const LightEdge& seen) {
            return seen.is_light == changes[i].is_light && seen.at >= from;
        });
        if (edge == edges.end() || (next && edge->at >= *next + earliest)) {
            ++found.unseen;
            continue;
        }
        delays_ms.push_back(1e3 * to_seconds(edge->at - changes[i].at));
    }
    found.matched = static_cast<int>(delays_ms.size());
    found.unasked = std::max(0, static_cast<int>(edges.size()) - found.matched);
    if (delays_ms.empty())
        return found;
    const double count = found.matched;
    for (const double delay : delays_ms)
        found.mean_ms += delay / count;
    for (const double delay : delays_ms)
        found.sd_ms += (delay - found.mean_ms) * (delay - found.mean_ms);
    found.sd_ms = delays_ms.size() > 1 ? std::sqrt(found.sd_ms / (count - 1.0)) : 0.0;
    const auto [lowest, highest] = std::ranges::minmax(delays_ms);
    found.lowest_ms = lowest;
    found.highest_ms = highest;
    return found;
}

} // namespace overt
