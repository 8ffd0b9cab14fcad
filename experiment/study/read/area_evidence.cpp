#include "experiment/study/read/area_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiment/base/parallel.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/scene/ray_caster.h"

namespace overt {

namespace {

/// On the shipped sculptures cells are 0.2 degrees apart in the picture, less than the error of any tracker.
constexpr std::size_t cell_count = 4000;

/// A tracker with smaller errors than this share of a cell's width is taken to have this one.
constexpr double least_sigma_cells = 0.6;

/// Fewer fixations than these do not tell how they are spread over the surface.
constexpr std::size_t least_fixations = 20;

/// Steps of the EM: the share of an area no longer changes in its third decimal, and noise is not yet
/// fitted.
constexpr int em_steps = 60;

/// Points of the surface that stand for equal areas about them.
struct Cells {
    std::vector<glm::dvec3> positions;
    std::vector<PartIndex> parts;
    double width = 0.0; ///< of a square of a cell's area, in the mesh's unit
};

Cells cells_of(const Mesh& mesh) {
    std::vector<double> up_to; // area up to and with each triangle
    double all = 0.0;
    const auto corner = [&](glm::uvec3 triangle, int i) { return glm::dvec3(mesh.positions[triangle[i]]); };
    for (const glm::uvec3& t : mesh.triangles) {
        all += 0.5 * glm::length(glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
        up_to.push_back(all);
    }
    Cells cells;
    cells.width = std::sqrt(all / cell_count);
    for (std::size_t i = 0; i < cell_count; ++i) {
        const double area = all * (static_cast<double>(i) + 0.5) / cell_count;
        const auto found = std::upper_bound(up_to.begin(), up_to.end() - 1, area);
        const auto triangle = static_cast<std::size_t>(found - up_to.begin());
        // Evenly over the triangle: the square root of one coordinate, the other by the golden ratio.
        const double begin = triangle > 0 ? up_to[triangle - 1] : 0.0, size = *found - begin;
        const double root = std::sqrt(size > 0.0 ? (area - begin) / size : 0.5);
        const double turn = static_cast<double>(i) / std::numbers::phi;
        const double share = turn - std::floor(turn);
        const glm::uvec3 t = mesh.triangles[triangle];
        cells.positions.push_back((1.0 - root) * corner(t, 0) + root * (1.0 - share) * corner(t, 1) +
                                  root * share * corner(t, 2));
        cells.parts.push_back(mesh.triangle_parts[triangle]);
    }
    return cells;
}

/// A cell that may have been looked at.
struct Candidate {
    std::uint32_t cell;
    float density; ///< of the measured place, per px^2
};

/// One pose's picture of the cells.
struct PosePicture {
    std::vector<std::uint32_t> visible;
    std::vector<glm::dvec2> places; ///< of those, px
    double cell_px = 0.0;           ///< width of a cell that faces the observer
};

/// What may have been looked at, whichever area is asked for.
class LookedAt {
  public:
    LookedAt(const Mesh& mesh, const SceneView& scene, std::span<const ObjectPose> poses,
             std::span<const MeasuredPlace> fixations)
        : cells_(cells_of(mesh)), fixations_(fixations), pictures_(poses.size()),
          candidates_(fixations.size()) {
        std::vector<std::uint8_t> is_used(poses.size(), 0);
        for (const MeasuredPlace& fixation : fixations)
            is_used[static_cast<std::size_t>(fixation.pose.value)] = 1;
        const RayCaster rays(mesh);
        parallel_for(static_cast<int>(poses.size()), [&](int pose) {
            const auto index = static_cast<std::size_t>(pose);
            if (is_used[index])
                draw(pictures_[index], SightLines(scene, poses[index]), rays, scene.view.image_px);
        });
        parallel_for(static_cast<int>(fixations.size()),
                     [&](int i) { find_candidates(static_cast<std::size_t>(i)); });
    }

    std::size_t told() const {
        return static_cast<std::size_t>(
            std::ranges::count_if(candidates_, [](const auto& of) { return !of.empty(); }));
    }
    const Cells& cells() const { return cells_; }
    const std::vector<PosePicture>& pictures() const { return pictures_; }
    const std::vector<std::vector<Candidate>>& candidates() const { return candidates_; } ///< by fixation
    std::size_t pose_of(std::size_t fixation) const {
        return static_cast<std::size_t>(fixations_[fixation].pose.value);
    }

  private:
    void draw(PosePicture& picture, const SightLines& lines, const RayCaster& rays, glm::ivec2 size) const {
        for (std::uint32_t cell = 0; cell < cells_.positions.size(); ++cell) {
            const glm::dvec3 seen = lines.project(cells_.positions[cell]);
            const bool is_inside =
                seen.z > 0.0 && seen.x >= 0.0 && seen.y >= 0.0 && seen.x < size.x && seen.y < size.y;
            if (is_inside && !rays.is_hidden(cells_.positions[cell], lines.origin())) {
                picture.visible.push_back(cell);
                picture.places.emplace_back(seen);
                picture.cell_px += cells_.width / lines.pixel_width_at(seen.z);
            }
        }
        picture.cell_px /= static_cast<double>(std::max<std::size_t>(picture.visible.size(), 1));
    }

    void find_candidates(std::size_t index) {
        const MeasuredPlace& fixation = fixations_[index];
        const PosePicture& picture = pictures_[static_cast<std::size_t>(fixation.pose.value)];
        // Anything of a cell may have been looked at, and between the pictures of two cells there is no gap.
        const glm::dvec2 sigma = glm::max(
            glm::sqrt(fixation.sigma_px * fixation.sigma_px + picture.cell_px * picture.cell_px / 12.0),
            glm::dvec2(least_sigma_cells * picture.cell_px));
        const double peak = 1.0 / (2.0 * std::numbers::pi * sigma.x * sigma.y);
        double nearest = 1e300;
        std::vector<Candidate>& found = candidates_[index];
        // Beyond four sigmas lie 0.03 % of errors.
        constexpr double negligible = 4.0 * 4.0;
        for (std::size_t i = 0; i < picture.visible.size(); ++i) {
            const glm::dvec2 off = (fixation.image_px - picture.places[i]) / sigma;
            const double squares = glm::dot(off, off);
            nearest = std::min(nearest, squares);
            if (squares < negligible)
                found.push_back({picture.visible[i], static_cast<float>(peak * std::exp(-0.5 * squares))});
        }
        if (nearest > farthest_sigmas * farthest_sigmas)
            found.clear();
    }

    Cells cells_;
    std::span<const MeasuredPlace> fixations_;
    std::vector<PosePicture> pictures_; ///< by pose
    std::vector<std::vector<Candidate>> candidates_;
};

/// Of one area.
class Deconvolution {
  public:
    Deconvolution(const LookedAt& looks, const Areas& areas, std::size_t area) : looks_(looks) {
        for (const PartIndex part : looks.cells().parts)
            is_inside_.push_back(areas.holds(area, part));
    }

    bool has_both() const {
        const auto inside = std::ranges::count(is_inside_, std::uint8_t{1});
        return inside > 0 && inside < static_cast<std::ptrdiff_t>(is_inside_.size());
    }

    void climb() {
        weights_.assign(is_inside_.size(), 1.0);
        share_ = 0.5;
        for (int step = 0; step < em_steps; ++step)
            climb_once();
    }

    /// By fixation.
    std::vector<AreaEvidence> evidence() const {
        const std::vector<std::array<double, 2>> seen = seen_weights();
        std::vector<AreaEvidence> found(looks_.candidates().size());
        for (std::size_t i = 0; i < found.size(); ++i)
            found[i] = evidence_of(i, seen);
        return found;
    }

  private:
    /// By pose: weight of the area's cells that are seen in it, and of the others.
    std::vector<std::array<double, 2>> seen_weights() const {
        const std::vector<PosePicture>& pictures = looks_.pictures();
        std::vector<std::array<double, 2>> seen(pictures.size(), {0.0, 0.0});
        for (std::size_t pose = 0; pose < pictures.size(); ++pose) {
            for (const std::uint32_t cell : pictures[pose].visible)
                seen[pose][is_inside_[cell]] += weights_[cell];
        }
        return seen;
    }

    AreaEvidence evidence_of(std::size_t index, const std::vector<std::array<double, 2>>& seen) const {
        std::array<double, 2> sums{0.0, 0.0};
        for (const Candidate& candidate : looks_.candidates()[index])
            sums[is_inside_[candidate.cell]] += weights_[candidate.cell] * candidate.density;
        const auto& of_pose = seen[looks_.pose_of(index)];
        return {of_pose[1] > 0.0 ? sums[1] / of_pose[1] : 0.0, of_pose[0] > 0.0 ? sums[0] / of_pose[0] : 0.0};
    }

    /// One step of EM. A cell's new weight is what it is held responsible for, divided by what it would be if
    /// all seen cells of its part were looked at evenly: in how many fixations it could be seen.
    void climb_once() {
        const std::vector<std::array<double, 2>> seen = seen_weights();
        std::vector<double> responsible(weights_.size(), 0.0);
        std::vector<std::array<double, 2>> of_pose(looks_.pictures().size(), {0.0, 0.0});
        double inside = 0.0, all = 0.0;
        const std::vector<std::vector<Candidate>>& candidates = looks_.candidates();
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (candidates[i].empty())
                continue;
            const std::size_t pose = looks_.pose_of(i);
            const std::array<double, 2> shares{1.0 - share_, share_};
            const AreaEvidence evidence = evidence_of(i, seen);
            const double total = shares[1] * evidence.inside + shares[0] * evidence.elsewhere;
            if (!(total > 0.0))
                continue;
            for (const Candidate& candidate : candidates[i]) {
                const std::uint8_t part = is_inside_[candidate.cell];
                responsible[candidate.cell] +=
                    shares[part] * weights_[candidate.cell] * candidate.density / (seen[pose][part] * total);
            }
            of_pose[pose][1] += shares[1] * evidence.inside / total;
            of_pose[pose][0] += shares[0] * evidence.elsewhere / total;
            inside += shares[1] * evidence.inside / total;
            all += 1.0;
        }
        std::vector<double> could(weights_.size(), 0.0);
        for (std::size_t pose = 0; pose < looks_.pictures().size(); ++pose) {
            for (const std::uint32_t cell : looks_.pictures()[pose].visible) {
                const std::uint8_t part = is_inside_[cell];
                if (seen[pose][part] > 0.0)
                    could[cell] += of_pose[pose][part] / seen[pose][part];
            }
        }
        for (std::size_t cell = 0; cell < weights_.size(); ++cell)
            weights_[cell] = could[cell] > 0.0 ? responsible[cell] / could[cell] : 0.0;
        share_ = all > 0.0 ? inside / all : 0.5;
    }

    const LookedAt& looks_;
    std::vector<std::uint8_t> is_inside_; ///< by cell
    std::vector<double> weights_;         ///< by cell
    double share_ = 0.5;
};

} // namespace

std::vector<std::vector<AreaEvidence>> area_evidence(const Mesh& mesh, const Areas& areas,
                                                     const SceneView& scene,
                                                     std::span<const ObjectPose> poses,
                                                     std::span<const MeasuredPlace> fixations) {
    std::vector<std::vector<AreaEvidence>> found(fixations.size());
    if (mesh.triangles.empty() || areas.empty() || fixations.size() < least_fixations)
        return found;
    const LookedAt looks(mesh, scene, poses, fixations);
    if (looks.told() < least_fixations)
        return found;
    std::vector<std::vector<AreaEvidence>> by_area(areas.size());
    parallel_for(static_cast<int>(areas.size()), [&](int i) {
        const auto area = static_cast<std::size_t>(i);
        Deconvolution deconvolution(looks, areas, area);
        if (!deconvolution.has_both())
            return;
        deconvolution.climb();
        by_area[area] = deconvolution.evidence();
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
        bool any = false;
        std::vector<AreaEvidence> of(areas.size());
        for (std::size_t area = 0; area < areas.size(); ++area) {
            if (!by_area[area].empty())
                of[area] = by_area[area][i];
            any = any || of[area].tells();
        }
        if (any)
            found[i] = std::move(of);
    }
    return found;
}

std::optional<double> most_probable_share(std::span<const AreaEvidence> fixations) {
    if (std::ranges::none_of(fixations, &AreaEvidence::tells))
        return std::nullopt;
    // The likelihood's logarithm is concave in the share: its slope falls, and has one root at most.
    const auto slope = [&](double share) {
        double sum = 0.0;
        for (const AreaEvidence& of : fixations) {
            if (!of.tells())
                continue;
            const double mixed = share * of.inside + (1.0 - share) * of.elsewhere;
            sum += mixed > 0.0 ? (of.inside - of.elsewhere) / mixed : (share < 0.5 ? 1e300 : -1e300);
        }
        return sum;
    };
    double low = 0.0, high = 1.0;
    if (slope(low) <= 0.0)
        return low;
    if (slope(high) >= 0.0)
        return high;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (slope(middle) > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace overt
