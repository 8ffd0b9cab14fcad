/// Brings the space about one object to that about another by places that correspond: landmarks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/base/enum_names.h"

namespace overt {

/// A warp that takes each landmark of one object exactly, or as nearly as its kind can, to that of another.
///
/// - thin_plate, from four landmarks on that do not lie in a plane: takes each exactly to its own, bends as
///   little as such a warp can in between (the integral of all squared second derivatives over space is
///   least; Duchon 1977; Bookstein, IEEE PAMI 11, 1989, 567-585), and is affine far away. In space it is A p
///   + t + sum of w_i |p - l_i| with sum w_i = 0 and sum w_i l_i^T = 0.
/// - similarity, of three, or of any number in a plane: turns, scales and shifts so that the sum of squared
///   distances is least (Umeyama, IEEE PAMI 13, 1991, 376-380); it never mirrors.
class LandmarkWarp {
  public:
    enum class Kind : std::uint8_t { similarity, thin_plate };

    /// Both are equally long, in any unit. Throws InputError, a clause without file or place, if there are
    /// fewer than three, if they lie on a line or two at one place on either object, or if the warp would
    /// turn space inside out, as it does where left and right were exchanged.
    LandmarkWarp(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);

    glm::dvec3 operator()(const glm::dvec3& position) const;

    Kind kind() const { return kind_; }
    /// How much longer things become: of a thin plate, the cube root of its affine part's determinant.
    double scale() const { return scale_; }
    /// How far each landmark is brought from its own by a warp of the other landmarks alone: root mean
    /// square, in the unit of `to`. Nothing where the others are too few for a warp of this kind.
    std::optional<double> left_out() const { return left_out_; }

  private:
    struct WithoutChecks {};
    LandmarkWarp(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, Kind kind, WithoutChecks);
    void find_left_out(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);

    Kind kind_ = Kind::similarity;
    double scale_ = 1.0;
    glm::dmat3 linear_{1.0};
    glm::dvec3 shift_{0.0};
    std::vector<glm::dvec3> landmarks_, weights_; ///< of the bending; empty of a similarity
    std::optional<double> left_out_;
};
template <>
inline constexpr auto names_of<LandmarkWarp::Kind> = enum_names<LandmarkWarp::Kind>("similarity",
                                                                                    "thin plate");

} // namespace overt
