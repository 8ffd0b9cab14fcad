/// Distances along a surface from one of its places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "experiment/surface/surface_geometry.h"

namespace overt {

/// Distances go from node to node in rising order, as Dijkstra's, but across triangles: two corners whose
/// distances are known say where the source would lie if the triangles on the way were unfolded into one
/// plane, and so how far the third corner is (Novotni and Klein 2002). On a plane distances come out exact
/// nearly everywhere; on a sphere with 10,000 nodes the error is 0.3 % of the distance on average (measured,
/// tests/experiment/surface). Triangles are those of the intrinsic Delaunay triangulation: few are so obtuse
/// that a way through them is overlooked and taken along their edges, which is longer.
///
/// Not for use from several threads at once; make one for each. It keeps its memory from one source to the
/// next.
class GeodesicField {
  public:
    static constexpr double unreached = std::numeric_limits<double>::infinity();

    /// `geometry` must live as long as the field.
    explicit GeodesicField(const SurfaceGeometry& geometry);

    /// Distances from a place, of all nodes nearer than `reach_mm`; the others, and those on other pieces of
    /// the surface, are unreached.
    void spread_from(const SurfacePlace& source, double reach_mm = unreached);

    /// The same until `is_enough` says so, which is told of each node with its distance, the nearest first:
    /// the other nodes are unreached then.
    using IsEnough = std::function<bool(std::uint32_t node, double distance)>;
    void spread_until(const SurfacePlace& source, double reach_mm, const IsEnough& is_enough);

    /// Millimetres along the surface, or unreached.
    double to_node(std::uint32_t node) const { return is_known(node) ? distances_[node] : unreached; }
    double to(const SurfacePlace& place) const;

    /// The nodes with a distance, the nearest first.
    std::span<const std::uint32_t> reached() const { return reached_; }

    const SurfaceGeometry& geometry() const { return geometry_; }

  private:
    struct Candidate {
        double distance;
        std::uint32_t node;
        friend bool operator<(const Candidate& a, const Candidate& b) {
            return a.distance != b.distance ? a.distance > b.distance : a.node > b.node;
        }
    };
    bool is_known(std::uint32_t node) const { return known_in_[node] == run_; }
    void offer(std::uint32_t node, double distance);
    void offer_around(std::uint32_t node);
    void offer_across(std::uint32_t node, std::uint32_t b, std::uint32_t c, double to_b, double to_c,
                      double b_to_c);

    const SurfaceGeometry& geometry_;
    SurfacePlace source_;
    double reach_mm_ = 0.0;
    std::uint32_t run_ = 0;
    std::vector<std::uint32_t> known_in_;   ///< by node: the run in which its distance became final
    std::vector<std::uint32_t> offered_in_; ///< the run in which `distances_` was last set
    std::vector<double> distances_;
    std::vector<std::uint32_t> reached_;
    std::vector<Candidate> heap_;
};

/// Where the weighted sum of distances along the surface to some places is least.
struct GeodesicMedian {
    std::size_t index = 0;         ///< of the weight at whose place it lies
    double mean_distance_mm = 0.0; ///< of the weights from there
    double unreached_share = 0.0;  ///< of the weight that lies on other pieces of the surface
};

/// The place among those of the weights whose sum of distances to the others is within `tolerance` of the
/// least. The median in space (Weiszfeld) is tried first: if distances along the surface from the place
/// nearest to it are hardly longer than straight ones, no other place can be much better, since no way is
/// shorter than the straight one; that is so for nearly all fixations. Otherwise, as when gaze went to and
/// fro across a gap, up to 16 places spread over the fixation are compared. There must be a weight above 0.
GeodesicMedian geodesic_median(GeodesicField& field, std::span<const SurfaceWeight> weights,
                               double tolerance = 0.05);

} // namespace overt
