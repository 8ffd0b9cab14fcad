#include "experiment/colour/characterisation_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "experiment/base/error.h"

namespace overt {

namespace {

struct Mean {
    glm::dvec3 xyz{0.0};
    int count = 0;
};

/// Signals as keys: a billionth apart is the same level.
using SignalKey = std::array<std::int64_t, 3>;
SignalKey key_of(const glm::dvec3& signal) {
    SignalKey key{};
    for (int i = 0; i < 3; ++i)
        key[static_cast<std::size_t>(i)] = std::llround(signal[i] * 1e9);
    return key;
}

class Means {
  public:
    explicit Means(std::span<const PatchReading> readings) {
        for (const PatchReading& reading : readings) {
            Mean& mean = means_[key_of(reading.signal)];
            mean.xyz += (reading.xyz - mean.xyz) / static_cast<double>(++mean.count);
        }
    }
    const Mean* at(const glm::dvec3& signal) const {
        const auto found = means_.find(key_of(signal));
        return found == means_.end() ? nullptr : &found->second;
    }
    const std::map<SignalKey, Mean>& all() const { return means_; }

  private:
    std::map<SignalKey, Mean> means_;
};

glm::dvec3 signal_of(const SignalKey& key) {
    return glm::dvec3(static_cast<double>(key[0]), static_cast<double>(key[1]), static_cast<double>(key[2])) /
           1e9;
}

glm::dvec3 alone(int channel, double signal) {
    glm::dvec3 all(0.0);
    all[channel] = signal;
    return all;
}

/// Makes what falls level, by means of neighbours (pool adjacent violators: Ayer et al. 1955, Ann. Math.
/// Stat. 26). Gives how many points were moved.
int make_monotone(std::vector<double>& values) {
    struct Block {
        double mean;
        int count;
    };
    std::vector<Block> blocks;
    for (const double value : values) {
        blocks.push_back({value, 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean > blocks.back().mean) {
            const Block last = blocks.back();
            blocks.pop_back();
            Block& before = blocks.back();
            before.mean = (before.mean * before.count + last.mean * last.count) / (before.count + last.count);
            before.count += last.count;
        }
    }
    int moved = 0;
    std::size_t i = 0;
    for (const Block& block : blocks) {
        for (int k = 0; k < block.count; ++k)
            values[i++] = block.mean;
        moved += block.count > 1 ? block.count : 0;
    }
    return moved;
}

/// A light that is nearly dark counts no more than a hundredth of full light does.
double weight_of(double light) { return 1.0 / (std::abs(light) + 0.01); }

double power_at(const glm::dvec3& parameters, double signal) {
    return parameters.x * ChannelCurve::power(parameters.y, parameters.z).light_of(signal);
}

double squares_of(const glm::dvec3& parameters, const std::vector<double>& signals,
                  const std::vector<double>& lights) {
    double sum = 0.0;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        const double error = (power_at(parameters, signals[i]) - lights[i]) * weight_of(lights[i]);
        sum += error * error;
    }
    return sum;
}

/// Gain, exponent and offset by Levenberg's and Marquardt's method.
glm::dvec3 fit_power(const std::vector<double>& signals, const std::vector<double>& lights) {
    const auto inside = [](glm::dvec3 p) {
        return glm::dvec3(std::clamp(p.x, 0.5, 2.0), std::clamp(p.y, 0.1, 10.0), std::clamp(p.z, -0.9, 0.9));
    };
    glm::dvec3 best(1.0, nearest_exponent(signals, lights), 0.0);
    double least = squares_of(best, signals, lights), damping = 1e-3;
    for (int round = 0; round < 200 && damping < 1e9; ++round) {
        glm::dmat3 normal(0.0);
        glm::dvec3 gradient(0.0);
        for (std::size_t i = 0; i < signals.size(); ++i) {
            const double weight = weight_of(lights[i]), value = power_at(best, signals[i]);
            glm::dvec3 slope;
            for (int k = 0; k < 3; ++k) {
                glm::dvec3 moved = best;
                moved[k] += 1e-6;
                slope[k] = (power_at(moved, signals[i]) - value) * 1e6 * weight;
            }
            normal += glm::outerProduct(slope, slope);
            gradient += slope * (lights[i] - value) * weight;
        }
        for (int k = 0; k < 3; ++k)
            normal[k][k] *= 1.0 + damping;
        const glm::dvec3 next = inside(best + glm::inverse(normal) * gradient);
        const double squares = squares_of(next, signals, lights);
        if (squares < least) {
            const bool is_done = least - squares < 1e-12 * least;
            best = next;
            least = squares;
            damping *= 0.3;
            if (is_done)
                break;
        } else {
            damping *= 4.0;
        }
    }
    return best;
}

ChannelFit fit_channel(const Means& means, int channel, const glm::dvec3& black, const glm::dvec3& full) {
    std::vector<double> signals{0.0}, lights{0.0};
    ChannelFit fit;
    const glm::dvec2 full_xy = chromaticity_of(full);
    for (const auto& [key, mean] : means.all()) {
        const glm::dvec3 signal = signal_of(key);
        if (signal[channel] <= 0.0 || signal != alone(channel, signal[channel]))
            continue;
        const glm::dvec3 light = mean.xyz - black;
        signals.push_back(signal[channel]);
        // As much of the full light as comes nearest to this one, the same weight on X, Y and Z.
        lights.push_back(signal[channel] == 1.0 ? 1.0 : glm::dot(light, full) / glm::dot(full, full));
        if (lights.back() >= 0.1) {
            const glm::dvec2 off = chromaticity_of(light) - full_xy;
            fit.chromaticity_drift = std::max({fit.chromaticity_drift, std::abs(off.x), std::abs(off.y)});
        }
    }
    fit.levels = static_cast<int>(signals.size()) - 1;
    if (fit.levels < 5)
        throw InputError(fmt::format("{} alone was read at {} levels; a curve needs five, full signal among "
                                     "them.",
                                     channel_names[static_cast<std::size_t>(channel)], fit.levels));
    const glm::dvec3 power = fit_power(signals, lights);
    fit.gain = power.x;
    fit.power = ChannelCurve::power(power.y, power.z);
    for (std::size_t i = 0; i < signals.size(); ++i)
        fit.power_rms += std::pow(power_at(power, signals[i]) - lights[i], 2.0);
    fit.power_rms = std::sqrt(fit.power_rms / static_cast<double>(signals.size()));
    fit.levelled = make_monotone(lights);
    const double dark = lights.front(), range = lights.back() - dark;
    if (!(range > 0.0))
        throw InputError(fmt::format("{} makes no more light with more signal: see what was measured.",
                                     channel_names[static_cast<std::size_t>(channel)]));
    for (double& light : lights)
        light = std::clamp((light - dark) / range, 0.0, 1.0);
    lights.back() = 1.0;
    fit.table = ChannelCurve::table(signals, lights, power.y);
    return fit;
}

double repeat_noise_of(const Means& means, std::span<const PatchReading> readings, double white) {
    double squares = 0.0;
    int free = 0;
    for (const PatchReading& reading : readings) {
        const Mean& mean = *means.at(reading.signal);
        if (mean.count < 2 || mean.xyz.y < 0.01 * white)
            continue;
        // Of n readings about their own mean n - 1 are free.
        squares += std::pow(reading.xyz.y / mean.xyz.y - 1.0, 2.0) * mean.count / (mean.count - 1.0);
        ++free;
    }
    return free > 0 ? std::sqrt(squares / free) : 0.0;
}

int lit_channels(const glm::dvec3& signal) { return (signal.x > 0.0) + (signal.y > 0.0) + (signal.z > 0.0); }

} // namespace

CharacterisationFit fit_characterisation(std::span<const PatchReading> readings, CurveModel model) {
    const Means means(readings);
    const Mean* black = means.at({0.0, 0.0, 0.0});
    if (!black)
        throw InputError("black was not read: without the light of signal 0, 0, 0 no curve can be told.");
    CharacterisationFit fit;
    fit.readings = static_cast<int>(readings.size());
    fit.patches = static_cast<int>(means.all().size());
    fit.display.black_xyz = glm::max(black->xyz, glm::dvec3(0.0));
    for (int channel = 0; channel < 3; ++channel) {
        const auto i = static_cast<std::size_t>(channel);
        const Mean* full = means.at(alone(channel, 1.0));
        if (!full)
            throw InputError(fmt::format("{} alone was not read at full signal.", channel_names[i]));
        const glm::dvec3 light = full->xyz - fit.display.black_xyz;
        if (!(light.y > 0.0))
            throw InputError(fmt::format(
                "{} at full signal is no brighter than black: see what was measured.", channel_names[i]));
        fit.channels[i] = fit_channel(means, channel, fit.display.black_xyz, light);
        const bool is_power = model == CurveModel::power;
        fit.display.curves[i] = is_power ? fit.channels[i].power : fit.channels[i].table;
        fit.display.primaries_xyz[i] = is_power ? fit.channels[i].gain * light : light;
    }
    if (independence_of(fit.display.primaries_xyz) < least_independence)
        throw InputError(
            "red, green and blue at full signal have the same colour, or one is a mixture of the "
            "others: see what was measured.");
    if (const Mean* white = means.at({1.0, 1.0, 1.0}))
        fit.display.measured_white_xyz = white->xyz;
    fit.repeat_noise = repeat_noise_of(means, readings, fit.display.white_xyz().y);
    return fit;
}

CharacterisationCheck check_characterisation(const DisplayCharacterisation& display,
                                             std::span<const PatchReading> readings) {
    const Means means(readings);
    CharacterisationCheck check;
    const double white = display.white_xyz().y;
    for (const auto& [key, mean] : means.all()) {
        const glm::dvec3 signal = signal_of(key);
        if (lit_channels(signal) < 2 || mean.xyz.y < 0.01 * white)
            continue;
        const glm::dvec3 predicted = display.xyz_of_signal(signal);
        const double luminance = std::abs(predicted.y / mean.xyz.y - 1.0);
        const glm::dvec2 off = glm::abs(chromaticity_of(predicted) - chromaticity_of(mean.xyz));
        const double xy = std::max(off.x, off.y);
        ++check.patches;
        check.luminance_mean += luminance;
        check.xy_mean += xy;
        check.xy_worst = std::max(check.xy_worst, xy);
        if (luminance > check.luminance_worst) {
            check.luminance_worst = luminance;
            check.worst_signal = signal;
        }
        // The same step with the others dark, and with them lit.
        for (int channel = 0; channel < 3; ++channel) {
            glm::dvec3 others = signal;
            others[channel] = 0.0;
            const Mean *below = means.at(others), *single = means.at(alone(channel, signal[channel])),
                       *black = means.at({0.0, 0.0, 0.0});
            if (!below || !single || !black || signal[channel] <= 0.0)
                continue;
            const double change = (mean.xyz.y - below->xyz.y) - (single->xyz.y - black->xyz.y);
            check.dependence = std::max(check.dependence.value_or(0.0), std::abs(change) / white);
        }
    }
    if (check.patches > 0) {
        check.luminance_mean /= check.patches;
        check.xy_mean /= check.patches;
    }
    if (const Mean* full = means.at({1.0, 1.0, 1.0}))
        check.additivity = std::abs(white / full->xyz.y - 1.0);
    return check;
}

} // namespace overt
