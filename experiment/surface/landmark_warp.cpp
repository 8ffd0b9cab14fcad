#include "experiment/surface/landmark_warp.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// Landmarks that are flatter than this, as a share of their extent, lie in a plane (or on a line): what is
/// told across it would be noise.
constexpr double flat = 0.02;

Eigen::Matrix3Xd columns_of(std::span<const glm::dvec3> places) {
    Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i)
        columns.col(static_cast<Eigen::Index>(i)) << places[i].x, places[i].y, places[i].z;
    return columns;
}

/// Extent along the principal axes, largest first: roots of the sums of squares.
Eigen::Vector3d extents_of(std::span<const glm::dvec3> places) {
    const Eigen::Matrix3Xd columns = columns_of(places);
    return (columns.colwise() - columns.rowwise().mean()).jacobiSvd().singularValues();
}

bool is_solid(std::span<const glm::dvec3> places) {
    const Eigen::Vector3d extents = extents_of(places);
    return places.size() > 3 && extents[2] > flat * extents[0];
}

bool are_on_a_line(std::span<const glm::dvec3> places) {
    if (places.size() < 3)
        return true;
    const Eigen::Vector3d extents = extents_of(places);
    return !(extents[1] > flat * extents[0]);
}

void expect_apart(std::span<const glm::dvec3> places, const char* whose) {
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (glm::distance(places[i], places[k]) <= 1e-9 * glm::length(places[i]))
                throw InputError(
                    fmt::format("landmarks {} and {} lie at one place of {}", k + 1, i + 1, whose));
}

} // namespace

LandmarkWarp::LandmarkWarp(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to,
                           LandmarkWarp::Kind kind, WithoutChecks /*tag*/)
    : kind_(kind) {
    const Eigen::Matrix3Xd sources = columns_of(from), targets = columns_of(to);
    const auto count = static_cast<Eigen::Index>(from.size());
    Eigen::Matrix3d linear;
    Eigen::Vector3d shift;
    if (kind == Kind::similarity) {
        const Eigen::Matrix4d moved = Eigen::umeyama(sources, targets, true);
        linear = moved.topLeftCorner<3, 3>();
        shift = moved.topRightCorner<3, 1>();
    } else {
        // In lengths of the landmarks' own extent, so that distances and constants are alike large.
        const Eigen::Vector3d middle = sources.rowwise().mean();
        const double size = (sources.colwise() - middle).colwise().norm().maxCoeff();
        const Eigen::Matrix3Xd unit = (sources.colwise() - middle) / size;
        Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 4, count + 4), wanted(count + 4, 3);
        for (Eigen::Index i = 0; i < count; ++i) {
            for (Eigen::Index k = 0; k < count; ++k)
                system(i, k) = (unit.col(i) - unit.col(k)).norm();
            system(i, count) = system(count, i) = 1.0;
            system.block<1, 3>(i, count + 1) = unit.col(i).transpose();
            system.block<3, 1>(count + 1, i) = unit.col(i);
        }
        wanted << targets.transpose(), Eigen::Matrix<double, 4, 3>::Zero();
        const Eigen::MatrixXd solved = system.fullPivLu().solve(wanted);
        linear = solved.bottomRows(3).transpose() / size;
        shift = solved.row(count).transpose() - linear * middle;
        landmarks_.assign(from.begin(), from.end());
        for (Eigen::Index i = 0; i < count; ++i)
            weights_.push_back(glm::dvec3(solved(i, 0), solved(i, 1), solved(i, 2)) / size);
    }
    for (int column = 0; column < 3; ++column)
        linear_[column] = {linear(0, column), linear(1, column), linear(2, column)};
    shift_ = {shift[0], shift[1], shift[2]};
    scale_ = std::cbrt(linear.determinant());
}

LandmarkWarp::LandmarkWarp(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) {
    OVERT_EXPECTS(from.size() == to.size());
    if (from.size() < 3)
        throw InputError(fmt::format("{} of them {}: it takes three at least, and four that do not lie in a "
                                     "plane for a warp that bends",
                                     from.size(), from.size() == 1 ? "corresponds" : "correspond"));
    expect_apart(from, "the object");
    expect_apart(to, "the template");
    if (are_on_a_line(from) || are_on_a_line(to))
        throw InputError("they lie on a line: add some beside it");
    const Kind kind = is_solid(from) && is_solid(to) ? Kind::thin_plate : Kind::similarity;
    *this = LandmarkWarp(from, to, kind, WithoutChecks{});
    if (!(scale_ > 0.0))
        throw InputError(
            "they turn the object inside out: left and right, or front and back, were exchanged on one of "
            "both");
    find_left_out(from, to);
}

void LandmarkWarp::find_left_out(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) {
    double squares = 0.0;
    for (std::size_t left = 0; left < from.size(); ++left) {
        std::vector<glm::dvec3> own(from.begin(), from.end()), other(to.begin(), to.end());
        own.erase(own.begin() + static_cast<std::ptrdiff_t>(left));
        other.erase(other.begin() + static_cast<std::ptrdiff_t>(left));
        const bool tells = kind_ == Kind::thin_plate ? is_solid(own) && is_solid(other)
                                                     : !are_on_a_line(own) && !are_on_a_line(other);
        if (!tells)
            return;
        const glm::dvec3 off = LandmarkWarp(own, other, kind_, WithoutChecks{})(from[left]) - to[left];
        squares += glm::dot(off, off);
    }
    left_out_ = std::sqrt(squares / static_cast<double>(from.size()));
}

glm::dvec3 LandmarkWarp::operator()(const glm::dvec3& position) const {
    glm::dvec3 moved = linear_ * position + shift_;
    for (std::size_t i = 0; i < landmarks_.size(); ++i)
        moved += weights_[i] * glm::distance(position, landmarks_[i]);
    return moved;
}

} // namespace overt
