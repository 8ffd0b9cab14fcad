#include "experiment/study/read/area_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "experiment/base/parallel.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/scene/ray_caster.h"

namespace overt {

namespace {

/// On the shipped sculptures the most cells are 0.2 degrees apart in the picture, less than the error of any
/// tracker.
constexpr std::size_t most_cells = 4000, least_cells = 1000;

/// Cells need not be smaller than this share of the tracker's standard error.
constexpr double cell_sigmas = 0.35;

/// A tracker with smaller errors than this share of a cell's width is taken to have this one.
constexpr double least_sigma_cells = 0.6;

/// Fewer fixations than these do not tell how they are spread over the surface.
constexpr std::size_t least_fixations = 20;

/// Steps of the EM: the share of an area no longer changes in its third decimal, and noise is not yet
/// fitted.
constexpr int em_steps = 60;

/// Shares of an area that a trial may have; how probable each is follows from all trials.
constexpr std::array<double, 8> trial_shares{0.01, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 0.99};

/// Errors of a trial that are less probable than this are left out of the steps until all are asked again.
constexpr double least_probable = 1e-4;
constexpr int steps_between_all = 10;

/// A place may be anywhere with so small a part of its peak's density: no single fixation rules an error of
/// its trial out.
constexpr double astray_density = 1e-4;

/// Of trial_errors(), in standard deviations, and a little more.
constexpr double farthest_error = 3.001;

/// A hexagon of places in a grid of triangles, out to 3 standard deviations, with the weights of a normal
/// distribution whose width gives what the rest leaves of the variance along each axis.
std::vector<TrialError> make_trial_errors() {
    constexpr double step = 0.75, variance = 1.0 - trial_error_rest * trial_error_rest;
    std::vector<glm::dvec2> places;
    constexpr int rings = 4;
    for (int a = -rings; a <= rings; ++a) {
        for (int b = -rings; b <= rings; ++b) {
            if (std::abs(a + b) <= rings)
                places.push_back(step * glm::dvec2(a + 0.5 * b, 0.5 * std::numbers::sqrt3 * b));
        }
    }
    std::vector<TrialError> errors;
    double low = 0.1, high = 10.0;
    for (int halving = 0; halving < 60; ++halving) {
        const double width = 0.5 * (low + high);
        errors.clear();
        double sum = 0.0, squares = 0.0;
        for (const glm::dvec2& place : places) {
            const double weight = std::exp(-0.5 * glm::dot(place, place) / width);
            errors.push_back({place, weight});
            sum += weight;
            squares += 0.5 * weight * glm::dot(place, place);
        }
        for (TrialError& error : errors)
            error.probability /= sum;
        (squares / sum < variance ? low : high) = width;
    }
    return errors;
}

/// Points of the surface that stand for equal areas about them.
struct Cells {
    std::vector<glm::dvec3> positions;
    std::vector<PartIndex> parts;
    double width = 0.0; ///< of a square of a cell's area, in the mesh's unit
};

Cells cells_of(const Mesh& mesh, double width) {
    std::vector<double> up_to; // area up to and with each triangle
    double all = 0.0;
    const auto corner = [&](glm::uvec3 triangle, int i) { return glm::dvec3(mesh.positions[triangle[i]]); };
    for (const glm::uvec3& t : mesh.triangles) {
        all += 0.5 * glm::length(glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
        up_to.push_back(all);
    }
    Cells cells;
    const auto count = static_cast<std::size_t>(
        std::clamp(all / (width * width), static_cast<double>(least_cells), static_cast<double>(most_cells)));
    cells.width = std::sqrt(all / static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const double area = all * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
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

/// Of a fixation, given each error of its trial.
struct Candidates {
    std::vector<Candidate> all;
    std::vector<std::uint32_t> begin; ///< by error, and the end; empty: the fixation tells nothing
    double astray = 0.0;              ///< per px^2, of a place that has to do with none of them
    bool tell() const { return !begin.empty(); }
    std::span<const Candidate> of(std::size_t error) const {
        return std::span(all).subspan(begin[error], begin[error + 1] - begin[error]);
    }
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
        : cells_(cells_of(mesh, cell_width(mesh, scene, poses.front(), fixations))), fixations_(fixations),
          pictures_(poses.size()), candidates_(fixations.size()) {
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
        return static_cast<std::size_t>(std::ranges::count_if(candidates_, &Candidates::tell));
    }
    const Cells& cells() const { return cells_; }
    const std::vector<PosePicture>& pictures() const { return pictures_; }
    const std::vector<Candidates>& candidates() const { return candidates_; } ///< by fixation
    int trial_of(std::size_t fixation) const { return fixations_[fixation].trial; }
    std::size_t pose_of(std::size_t fixation) const {
        return static_cast<std::size_t>(fixations_[fixation].pose.value);
    }

  private:
    /// In the mesh's unit, from the most exact of the fixations.
    static double cell_width(const Mesh& mesh, const SceneView& scene, const ObjectPose& pose,
                             std::span<const MeasuredPlace> fixations) {
        double least_px = 1e300;
        for (const MeasuredPlace& fixation : fixations)
            least_px = std::min({least_px, fixation.sigma_px.x, fixation.sigma_px.y});
        const SightLines lines(scene, pose);
        return cell_sigmas * least_px * lines.pixel_width_at(lines.project(mesh.bounds().centre()).z);
    }

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
        const auto widened = [&](const glm::dvec2& sigma_px) {
            return glm::max(glm::sqrt(sigma_px * sigma_px + picture.cell_px * picture.cell_px / 12.0),
                            glm::dvec2(least_sigma_cells * picture.cell_px));
        };
        const glm::dvec2 whole = widened(fixation.sigma_px),
                         rest = widened(trial_error_rest * fixation.sigma_px);
        // Beyond 3.5 sigmas lie 0.2 % of errors.
        constexpr double negligible = 3.5 * 3.5;
        // Farther from the measured place no error of the trial reaches.
        const glm::dvec2 reach = farthest_error * fixation.sigma_px + std::sqrt(negligible) * rest;
        std::vector<std::size_t> near;
        double nearest = 1e300;
        for (std::size_t i = 0; i < picture.places.size(); ++i) {
            const glm::dvec2 away = fixation.image_px - picture.places[i], off = away / whole;
            nearest = std::min(nearest, glm::dot(off, off));
            if (std::abs(away.x) <= reach.x && std::abs(away.y) <= reach.y)
                near.push_back(i);
        }
        if (nearest > farthest_sigmas * farthest_sigmas)
            return;
        const double peak = 1.0 / (2.0 * std::numbers::pi * rest.x * rest.y);
        Candidates& found = candidates_[index];
        found.astray = astray_density * peak;
        for (const TrialError& error : trial_errors()) {
            found.begin.push_back(static_cast<std::uint32_t>(found.all.size()));
            const glm::dvec2 meant = fixation.image_px - error.sigmas * fixation.sigma_px;
            for (const std::size_t i : near) {
                const glm::dvec2 off = (meant - picture.places[i]) / rest;
                const double squares = glm::dot(off, off);
                if (squares < negligible)
                    found.all.push_back(
                        {picture.visible[i], static_cast<float>(peak * std::exp(-0.5 * squares))});
            }
        }
        found.begin.push_back(static_cast<std::uint32_t>(found.all.size()));
    }

    Cells cells_;
    std::span<const MeasuredPlace> fixations_;
    std::vector<PosePicture> pictures_; ///< by pose
    std::vector<Candidates> candidates_;
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
        share_probabilities_.fill(1.0 / trial_shares.size());
        find_trials();
        for (int step = 0; step < em_steps; ++step)
            climb_once(step % steps_between_all == 0);
    }

    /// By fixation.
    std::vector<AreaEvidence> evidence() {
        const std::vector<std::array<double, 2>> seen = seen_weights();
        std::vector<AreaEvidence> found(looks_.candidates().size());
        TrialLikelihood likelihood;
        for (Trial& trial : trials_) {
            ask(likelihood, trial, true, seen);
            for (std::size_t i = trial.begin; i < trial.end; ++i)
                found[i] = evidence_beside_others(likelihood, trial, i);
        }
        return found;
    }

  private:
    /// What a fixation's place is like, given an error of its trial, if the area was looked at, and if not.
    struct Given {
        double inside = 0.0, elsewhere = 0.0;
        double with(double share, double astray) const {
            return share * inside + (1.0 - share) * elsewhere + astray;
        }
    };

    /// Fixations from begin to end.
    struct Trial {
        std::size_t begin = 0, end = 0;
        std::vector<std::size_t> errors; ///< those that are not improbable
    };

    struct TrialLikelihood {
        std::vector<Given> given;     ///< by fixation and error
        std::vector<double> probable; ///< by error and share, given all fixations; their sum is 1
    };

    void find_trials() {
        const std::size_t fixations = looks_.candidates().size();
        trials_.clear();
        for (std::size_t begin = 0, end = 0; begin < fixations; begin = end) {
            while (end < fixations && looks_.trial_of(end) == looks_.trial_of(begin))
                ++end;
            trials_.push_back({begin, end, {}});
        }
    }

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

    Given given(std::size_t index, std::size_t error, const std::vector<std::array<double, 2>>& seen) const {
        std::array<double, 2> sums{0.0, 0.0};
        for (const Candidate& candidate : looks_.candidates()[index].of(error))
            sums[is_inside_[candidate.cell]] += weights_[candidate.cell] * candidate.density;
        const auto& of_pose = seen[looks_.pose_of(index)];
        return {of_pose[1] > 0.0 ? sums[1] / of_pose[1] : 0.0, of_pose[0] > 0.0 ? sums[0] / of_pose[0] : 0.0};
    }

    /// Of all errors, which tells those that are probable, or of these.
    void ask(TrialLikelihood& likelihood, Trial& trial, bool all,
             const std::vector<std::array<double, 2>>& seen) const {
        const std::span<const TrialError> errors = trial_errors();
        if (all) {
            trial.errors.resize(errors.size());
            std::iota(trial.errors.begin(), trial.errors.end(), std::size_t{0});
        }
        likelihood.given.assign((trial.end - trial.begin) * errors.size(), {});
        std::vector<double>& probable = likelihood.probable;
        probable.assign(errors.size() * trial_shares.size(), 0.0);
        for (const std::size_t error : trial.errors) {
            for (std::size_t share = 0; share < trial_shares.size(); ++share)
                probable[error * trial_shares.size() + share] =
                    errors[error].probability * share_probabilities_[share];
        }
        constexpr std::size_t before_scaled = 12; // factors are no less than astray_density
        for (std::size_t i = trial.begin; i < trial.end; ++i) {
            const Candidates& candidates = looks_.candidates()[i];
            if (!candidates.tell())
                continue;
            const double scale = astray_density / candidates.astray;
            for (const std::size_t error : trial.errors) {
                const Given of = likelihood.given[(i - trial.begin) * errors.size() + error] =
                    given(i, error, seen);
                double* const own = &probable[error * trial_shares.size()];
                for (std::size_t share = 0; share < trial_shares.size(); ++share)
                    own[share] *= scale * of.with(trial_shares[share], candidates.astray);
            }
            if ((i - trial.begin) % before_scaled == before_scaled - 1)
                divide_by_sum(probable);
        }
        divide_by_sum(probable);
        std::erase_if(trial.errors, [&](std::size_t error) {
            const auto own = probable.begin() + static_cast<std::ptrdiff_t>(error * trial_shares.size());
            return all && std::accumulate(own, own + trial_shares.size(), 0.0) < least_probable;
        });
    }

    static void divide_by_sum(std::vector<double>& values) {
        const double sum = std::accumulate(values.begin(), values.end(), 0.0);
        for (double& value : values)
            value /= sum;
    }

    /// Given what the other fixations of the trial leave probable of its error.
    AreaEvidence evidence_beside_others(const TrialLikelihood& likelihood, const Trial& trial,
                                        std::size_t fixation) const {
        const Candidates& candidates = looks_.candidates()[fixation];
        if (!candidates.tell())
            return {};
        AreaEvidence evidence;
        double all = 0.0;
        for (std::size_t error = 0; error < trial_errors().size(); ++error) {
            const Given& of = likelihood.given[(fixation - trial.begin) * trial_errors().size() + error];
            double others = 0.0;
            for (std::size_t share = 0; share < trial_shares.size(); ++share)
                others += likelihood.probable[error * trial_shares.size() + share] /
                          of.with(trial_shares[share], candidates.astray);
            all += others;
            evidence.inside += others * of.inside;
            evidence.elsewhere += others * of.elsewhere;
        }
        return {evidence.inside / all, evidence.elsewhere / all};
    }

    /// One step of EM. A cell's new weight is what it is held responsible for, divided by what it would be if
    /// all seen cells of its part were looked at evenly: in how many fixations it could be seen.
    void climb_once(bool of_all_errors) {
        const std::vector<std::array<double, 2>> seen = seen_weights();
        std::vector<double> responsible(weights_.size(), 0.0);
        std::vector<std::array<double, 2>> of_pose(looks_.pictures().size(), {0.0, 0.0});
        std::array<double, trial_shares.size()> of_shares{};
        TrialLikelihood likelihood;
        for (Trial& trial : trials_) {
            ask(likelihood, trial, of_all_errors, seen);
            for (std::size_t i = 0; i < likelihood.probable.size(); ++i)
                of_shares[i % of_shares.size()] += likelihood.probable[i];
            for (std::size_t i = trial.begin; i < trial.end; ++i) {
                if (!looks_.candidates()[i].tell())
                    continue;
                for (const std::size_t error : trial.errors)
                    hold_responsible(
                        i, error, likelihood.given[(i - trial.begin) * trial_errors().size() + error],
                        &likelihood.probable[error * trial_shares.size()], seen, responsible, of_pose);
            }
        }
        for (std::size_t share = 0; share < of_shares.size(); ++share)
            share_probabilities_[share] = of_shares[share] / static_cast<double>(trials_.size());
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
    }

    /// Of a fixation, as probable as an error of its trial is, with each share.
    void hold_responsible(std::size_t fixation, std::size_t error, const Given& given, const double* probable,
                          const std::vector<std::array<double, 2>>& seen, std::vector<double>& responsible,
                          std::vector<std::array<double, 2>>& of_pose) const {
        const Candidates& candidates = looks_.candidates()[fixation];
        std::array<double, 2> factors{0.0, 0.0}; // elsewhere, inside
        for (std::size_t i = 0; i < trial_shares.size(); ++i) {
            const double share = trial_shares[i];
            const double by = probable[i] / given.with(share, candidates.astray);
            factors[1] += by * share;
            factors[0] += by * (1.0 - share);
        }
        const std::size_t pose = looks_.pose_of(fixation);
        of_pose[pose][1] += factors[1] * given.inside;
        of_pose[pose][0] += factors[0] * given.elsewhere;
        for (std::size_t part : {std::size_t{0}, std::size_t{1}})
            factors[part] = seen[pose][part] > 0.0 ? factors[part] / seen[pose][part] : 0.0;
        for (const Candidate& candidate : candidates.of(error))
            responsible[candidate.cell] +=
                factors[is_inside_[candidate.cell]] * weights_[candidate.cell] * candidate.density;
    }

    const LookedAt& looks_;
    std::vector<std::uint8_t> is_inside_; ///< by cell
    std::vector<double> weights_;         ///< by cell
    std::array<double, trial_shares.size()> share_probabilities_{};
    std::vector<Trial> trials_;
};

} // namespace

std::span<const TrialError> trial_errors() {
    static const std::vector<TrialError> errors = make_trial_errors();
    return errors;
}

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

std::vector<double> shares_of_observers(std::span<const std::vector<AreaEvidence>> observers) {
    std::vector<AreaEvidence> all;
    for (const std::vector<AreaEvidence>& own : observers)
        std::ranges::copy_if(own, std::back_inserter(all), &AreaEvidence::tells);
    const std::optional<double> most_probable = most_probable_share(all);
    if (!most_probable)
        return {};
    // Near an end nobody's fixations are on both sides, so that nothing tells how much one of them says.
    constexpr double nearest_to_an_end = 0.02;
    if (std::min(*most_probable, 1.0 - *most_probable) < nearest_to_an_end) {
        std::vector<double> shares;
        for (const std::vector<AreaEvidence>& own : observers)
            if (const std::optional<double> of_own = most_probable_share(own))
                shares.push_back(*of_own);
        return shares;
    }
    const double share = *most_probable;
    struct Score {
        double sum = 0.0, squares = 0.0, fixations = 0.0;
        void add(const AreaEvidence& of, double at) {
            const double slope = (of.inside - of.elsewhere) / (at * of.inside + (1.0 - at) * of.elsewhere);
            sum += slope;
            squares += slope * slope;
            ++fixations;
        }
    };
    Score together;
    for (const AreaEvidence& of : all)
        together.add(of, share);
    // By its own fixations alone an observer's divisor would go with the dividend.
    constexpr double of_all = 100.0;
    const double mean_square = together.squares / together.fixations;
    std::vector<double> shares;
    for (const std::vector<AreaEvidence>& own : observers) {
        Score score;
        for (const AreaEvidence& of : own) {
            if (of.tells())
                score.add(of, share);
        }
        const double square = (score.squares + of_all * mean_square) / (score.fixations + of_all);
        if (score.fixations > 0.0)
            shares.push_back(share + (square > 0.0 ? score.sum / (score.fixations * square) : 0.0));
    }
    return shares;
}

} // namespace overt
