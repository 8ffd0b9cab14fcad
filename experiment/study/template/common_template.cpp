#include "experiment/study/template/common_template.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/study/read/exposure.h"
#include "experiment/study/template/object_landmarks.h"
#include "experiment/study/template/surface_bridge.h"
#include "experiment/study/template/visibility_on_template.h"

namespace overt {

namespace {

bool is_same_surface(const StudyObject& a, const StudyObject& b) {
    return a.mesh == b.mesh ||
           (a.mesh->positions == b.mesh->positions && a.mesh->triangles == b.mesh->triangles &&
            a.mesh->triangle_parts == b.mesh->triangle_parts && a.part_names == b.part_names);
}

class TemplateMaker {
  public:
    TemplateMaker(ReadStudy& study, const StudyOptions& options)
        : study_(study), results_(study.results), options_(options), onto_(template_index()) {}

    void run() {
        find_shown();
        for (const auto& [object, trials] : shown_)
            bridges_.emplace(object, bridge_of(object));
        lay_visibility();
        for (const auto& [object, trials] : shown_)
            add_fit(object);
        lay_gaze();
        lay_points();
        for (StudyTrial& trial : results_.trials)
            trial.object = onto_;
        // What no trial is on any more has no areas to ask for.
        for (int object = 0; object < static_cast<int>(results_.objects.size()); ++object)
            if (object != onto_)
                object_at(object).areas = Areas();
        remark();
    }

  private:
    StudyObject& object_at(int index) { return results_.objects[static_cast<std::size_t>(index)]; }
    const StudyObject& onto() { return object_at(onto_); }
    ObjectSurface& surface_at(int index) { return study_.surfaces[static_cast<std::size_t>(index)]; }

    int template_index() const {
        std::optional<int> found;
        std::vector<std::string> ids;
        for (std::size_t i = 0; i < results_.objects.size(); ++i) {
            const StudyObject& object = results_.objects[i];
            if (object.id == options_.onto.object &&
                (!found || !results_.objects[static_cast<std::size_t>(*found)].mesh))
                found = static_cast<int>(i);
            if (std::ranges::find(ids, object.id) == ids.end())
                ids.push_back(object.id);
        }
        if (!found)
            throw InputError(
                fmt::format("--template {}: no object of these sessions is called so; there {} {}",
                            options_.onto.object, ids.size() == 1 ? "is" : "are", fmt::join(ids, ", ")));
        expect_surface(results_.objects[static_cast<std::size_t>(*found)]);
        return *found;
    }

    void expect_surface(const StudyObject& object) const {
        if (!object.mesh || !object.mm_per_unit)
            throw InputError(
                fmt::format("--template {}: {} has no mesh in these sessions, or its size is not "
                            "known, so that places on it belong nowhere else: leave out the "
                            "sessions that show it",
                            options_.onto.object, object.id));
    }

    /// Objects by the trials that show them and are not excluded; of a study without any, none.
    void find_shown() {
        for (const StudyTrial& trial : results_.trials)
            shown_[trial.object] += trial.excluded ? 0 : 1;
        for (const auto& [object, trials] : shown_)
            expect_surface(object_at(object));
    }

    std::unique_ptr<SurfaceBridge> bridge_of(int index) {
        const StudyObject& object = object_at(index);
        if (is_same_surface(object, onto()))
            return nullptr;
        const LandmarksByName own = landmarks_of(object, options_.onto),
                              others = landmarks_of(onto(), options_.onto);
        std::vector<glm::dvec3> from, to;
        for (const auto& [name, place] : own) {
            if (const auto found = others.find(name); found != others.end()) {
                from.push_back(place);
                to.push_back(found->second);
            }
        }
        landmarks_[index] = static_cast<int>(from.size());
        try {
            return std::make_unique<SurfaceBridge>(object, onto(), LandmarkWarp(from, to));
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: of the {} of {} and the template {}, {}", source_of_landmarks(),
                                         options_.onto.lists.empty() && options_.onto.landmarks.empty()
                                             ? "middles of the areas"
                                             : "landmarks",
                                         object.id, onto().id, error.what()));
        }
    }

    std::string source_of_landmarks() const {
        if (!options_.onto.file.empty())
            return options_.onto.file;
        return options_.onto.lists.empty()
                   ? fmt::format("--template {}", options_.onto.object)
                   : fmt::format("--landmarks {}", fmt::join(options_.onto.lists, ","));
    }

    const SurfaceBridge* bridge(int object) const { return bridges_.at(object).get(); }

    /// Seconds and pixels of the template as the trials' objects had them.
    void lay_visibility() {
        const Mesh& mesh = *onto().mesh;
        double trials_of_all = 0.0;
        for (const auto& [object, trials] : shown_)
            trials_of_all += trials;
        VisibilityOnTemplate laid(mesh);
        for (const auto& [index, trials] : shown_)
            laid.add(object_at(index), surface_at(index).pixel_seconds, bridge(index),
                     trials_of_all > 0.0 ? trials / trials_of_all : 1.0 / static_cast<double>(shown_.size()));
        results_.exposures =
            exposure_rows({laid.exposure(), mesh, *onto().mm_per_unit, 1.0}, onto_, onto().areas);
        for (ExposureRow& row : results_.exposures)
            row.foreshortening.reset(); // of pixels of several objects' pictures
        object_at(onto_).seconds_visible = laid.exposure().seconds_visible;
        surface_at(onto_).pixel_seconds = laid.exposure().pixel_seconds;
    }

    void add_fit(int index) {
        TemplateFitRow row;
        row.object = index;
        const SurfaceBridge* const across = bridge(index);
        if (!across) {
            row.warp = "the same surface";
            results_.template_fits.push_back(std::move(row));
            return;
        }
        row.landmarks = landmarks_.at(index);
        row.warp = name_of(across->warp().kind());
        row.scale = across->warp().scale();
        row.left_out_mm = across->warp().left_out();
        const Mesh& mesh = *object_at(index).mesh;
        std::vector<glm::dvec3> of_triangles(mesh.triangles.size()); // area, area times distance, turned area
        parallel_for(static_cast<int>(mesh.triangles.size()), [&](int i) {
            const auto triangle = static_cast<std::uint32_t>(i);
            const SurfaceBridge::Laid laid = across->onto_template({triangle, glm::dvec3(1.0 / 3.0)});
            const glm::dvec3 normal = across->warped_normal(triangle);
            const double area = glm::length(normal);
            const bool is_turned =
                glm::dot(normal, normal_of_triangle(*onto().mesh, laid.site.triangle)) < 0.0;
            of_triangles[triangle] = {area, area * laid.away_mm, is_turned ? area : 0.0};
        });
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& of : of_triangles)
            sum += of;
        row.away_mm = sum.x > 0.0 ? sum.y / sum.x : 0.0;
        row.turned_share = sum.x > 0.0 ? sum.z / sum.x : 0.0;
        results_.template_fits.push_back(std::move(row));
    }

    TemplateFitRow& fit_of(int object) {
        return *std::ranges::find(results_.template_fits, object, &TemplateFitRow::object);
    }

    void lay_gaze() {
        std::map<int, double> away;
        for (StudyFixation& fixation : results_.fixations) {
            const int index = results_.trials[static_cast<std::size_t>(fixation.trial)].object;
            TemplateFitRow& fit = fit_of(index);
            fit.fixations += fixation.counted();
            const SurfaceBridge* const across = bridge(index);
            if (index != onto_)
                lay_evidence(fixation, object_at(index));
            if (!across)
                continue;
            const double longer = across->warp().scale();
            if (!options_.sigma.is_mm)
                fixation.sigma_mm *= longer;
            fixation.mm_per_deg *= longer;
            for (std::optional<double>* length : {&fixation.spread_mm, &fixation.cone_mm, &fixation.lut_mm})
                if (*length)
                    **length *= longer;
            if (!fixation.triangle)
                continue;
            const SurfaceBridge::Laid laid =
                across->onto_template({*fixation.triangle, fixation.barycentric}, fixation.part);
            fixation.triangle = laid.site.triangle;
            fixation.barycentric = laid.site.barycentric;
            fixation.position = position_of(*onto().mesh, laid.site);
            fixation.part = onto().mesh->triangle_parts[laid.site.triangle];
            if (fixation.counted())
                away[index] += laid.away_mm;
        }
        for (const auto& [index, sum_mm] : away)
            fit_of(index).gaze_away_mm = sum_mm / fit_of(index).fixations;
    }

    /// By the template's areas: what it does not share with the object tells nothing.
    void lay_evidence(StudyFixation& fixation, const StudyObject& object) {
        if (fixation.evidence.empty())
            return;
        std::vector<AreaEvidence> laid(onto().areas.size());
        for (std::size_t area = 0; area < laid.size(); ++area)
            if (const std::optional<std::size_t> own = object.areas.find(onto().areas.names()[area]))
                laid[area] = fixation.evidence[*own];
        fixation.evidence = std::move(laid);
    }

    void lay_points() {
        for (AnsweredPointRow& point : results_.points.given) {
            const int index = std::exchange(point.of.object, onto_);
            const auto found = bridges_.find(index);
            if (found == bridges_.end() || !found->second || !point.triangle)
                continue;
            const SurfaceBridge& across = *found->second;
            const std::optional<PartIndex> part =
                point.part ? std::optional(static_cast<PartIndex>(*point.part)) : std::nullopt;
            const SurfaceSite site = across.onto_template({*point.triangle, point.barycentric}, part).site;
            point.triangle = site.triangle;
            point.barycentric = site.barycentric;
            point.place = position_of(*onto().mesh, site);
            point.part = onto().mesh->triangle_parts[site.triangle];
            point.part_name = onto().mesh->part_names[*point.part];
            // In the template's unit, from the object's.
            if (point.largest_sd)
                *point.largest_sd *=
                    across.warp().scale() * *object_at(index).mm_per_unit / *onto().mm_per_unit;
        }
    }

    void remark() {
        std::vector<std::string> brought;
        for (const TemplateFitRow& fit : results_.template_fits) {
            if (fit.landmarks == 0)
                continue;
            brought.push_back(fmt::format(
                "{} (by {} landmarks{}; its surface lay {:.3g} mm away on average)", object_at(fit.object).id,
                fit.landmarks,
                fit.left_out_mm
                    ? fmt::format(", of which each is told by the others to {:.3g} mm", *fit.left_out_mm)
                    : "",
                fit.away_mm));
            if (fit.turned_share > 0.02)
                results_.remarks.push_back(fmt::format(
                    "{:.0f} % of the surface of {} come to lie on a part of {} that faces the other way: "
                    "gaze "
                    "there may be on the wrong side of it. More landmarks, or areas of both, mend that.",
                    100.0 * fit.turned_share, object_at(fit.object).id, onto().id));
        }
        if (!brought.empty())
            results_.remarks.insert(
                results_.remarks.begin(),
                fmt::format("All places are on {}. Those on others were brought to it: {}. "
                            "The table template_fit has the rest.",
                            onto().id, fmt::join(brought, ", ")));
    }

    ReadStudy& study_;
    StudyResults& results_;
    const StudyOptions& options_;
    int onto_;
    std::map<int, int> shown_;                              ///< trials by object
    std::map<int, int> landmarks_;                          ///< their number by object
    std::map<int, std::unique_ptr<SurfaceBridge>> bridges_; ///< null: of the template's own surface
};

} // namespace

void bring_to_template(ReadStudy& study, const StudyOptions& options) {
    if (!options.onto.object.empty())
        TemplateMaker(study, options).run();
}

} // namespace overt
