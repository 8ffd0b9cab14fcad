/// Sensitivity (d') and criterion from answers to signals and noise, or from shares of correct answers in
/// designs with several intervals or stimuli (Macmillan and Creelman, Detection Theory, 2005).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/base/enum_names.h"

namespace overt {

/// What keeps shares from being 0 or 1.
enum class ShareCorrection : std::uint8_t {
    none,
    log_linear, ///< (h + 0.5) / (n + 1) of all shares (Hautus 1995)
    extreme     ///< 1 / (2 n) in place of 0, and 1 - 1 / (2 n) in place of 1, others as they are
};
template <>
inline constexpr auto names_of<ShareCorrection> = enum_names<ShareCorrection>("none", "log-linear", "1/(2N)");

struct DetectionCounts {
    double hits = 0.0, misses = 0.0, false_alarms = 0.0, correct_rejections = 0.0;
};

struct DetectionEstimate {
    double d_prime = 0.0;          ///< infinite without correction where a share is 0 or 1
    double criterion = 0.0;        ///< c = -(z(H) + z(F)) / 2
    double log_beta = 0.0;         ///< c d'
    std::optional<double> se = {}; ///< of d', by the delta method; nothing where a share is 0 or 1
};

/// Yes-no. Both kinds of trials must be there.
DetectionEstimate yes_no(const DetectionCounts& counts, ShareCorrection correction);

/// Two alternatives or intervals, with the bias to one of them taken out: `hits` are "first" answers where
/// the first is right, `false_alarms` "first" answers where the second is. d' and its error are those of
/// yes-no divided by sqrt 2.
DetectionEstimate two_alternatives(const DetectionCounts& counts, ShareCorrection correction);

/// How answers come about where only the share of correct ones is known; observers without bias.
enum class DetectionDesign : std::uint8_t {
    yes_no,
    alternatives, ///< m of them
    abx_differencing,
    abx_independent,
    same_different_independent,
    oddity ///< of three, the triangle test
};
template <>
inline constexpr auto names_of<DetectionDesign> = enum_names<DetectionDesign>(
    "yes-no", "alternatives", "ABX, differencing", "ABX, independent observations",
    "same-different, independent observations", "oddity of three");

/// The share of correct answers. d' >= 0; `alternatives` counts those of that design, at least 2.
double correct_share(DetectionDesign design, double d_prime, int alternatives = 2);

/// Same-different by differencing: hits ("different" to different ones) at a share of false alarms, 0 < F
/// < 1.
double same_different_hits(double d_prime, double false_alarms);

/// The d' of so many correct answers. At or below chance it is 0; nothing where all are correct.
std::optional<double> d_prime_of_share(DetectionDesign design, double share, int alternatives = 2);
/// The d' of hits and false alarms by differencing; 0 for no more hits than false alarms.
std::optional<double> d_prime_same_different(double hits, double false_alarms);

/// With its standard error by the delta method, sqrt(p (1 - p) / n) divided by the curve's slope.
struct DesignEstimate {
    double d_prime = 0.0;
    std::optional<double> se = {}; ///< nothing at or below chance
};
std::optional<DesignEstimate> estimate_d_prime(DetectionDesign design, double correct, double trials,
                                               ShareCorrection correction, int alternatives = 2);

} // namespace overt
