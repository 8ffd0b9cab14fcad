/// From a channel's signal to its light: what is commonly called gamma.
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace overt {

/// The channels of a screen, in the order in which they are stored.
inline constexpr std::array<std::string_view, 3> channel_names{"red", "green", "blue"};

/// Light of one channel at a signal of 0 … 1, relative to that at full signal, with the black level taken
/// off: 0 at 0, 1 at 1, never falling.
///
/// Either a power, after Berns (1996), "Methods for characterizing CRT displays", Displays 16(4):
///     light = (g(signal) - g(0)) / (1 - g(0)),  g(s) = max(0, (1 - offset) s + offset)^exponent;
/// or a measured table, between whose points light^(1 / exponent) is interpolated by cubics that rise
/// wherever the points do (Fritsch & Butland 1984, SIAM J. Sci. Stat. Comput. 5). In that measure a usual
/// display's curve is nearly straight, and few points suffice; an exponent of 1 interpolates light itself.
class ChannelCurve {
  public:
    /// No curve: light is the signal.
    ChannelCurve() = default;

    /// `exponent` 0.1 … 10; `offset` -0.9 … 0.9.
    static ChannelCurve power(double exponent, double offset = 0.0);

    /// Signals rise from 0 to 1, lights never fall and go from 0 to 1; at least two. `exponent` as above.
    static ChannelCurve table(std::vector<double> signals, std::vector<double> lights, double exponent);

    double light_of(double signal) const noexcept;

    bool is_table() const { return !signals_.empty(); }
    double exponent() const { return exponent_; }
    double offset() const { return offset_; }                       ///< of a power
    const std::vector<double>& signals() const { return signals_; } ///< of a table
    const std::vector<double>& lights() const { return lights_; }

  private:
    double exponent_ = 1.0, offset_ = 0.0;
    std::vector<double> signals_, lights_;
    std::vector<double> heights_, slopes_; ///< light^(1 / exponent) at the points
};

/// Exponent of the power function of the signal that the points of a table lie nearest to (least squares of
/// logarithms), 0.1 … 10; 1 where no point lies between both ends.
double nearest_exponent(const std::vector<double>& signals, const std::vector<double>& lights);

} // namespace overt
