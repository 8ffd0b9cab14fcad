/// A ball and an egg, of which each fixation on the egg has its place on the ball.
#include "experiment/study/template/common_template.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/surface_sites.h"
#include "tests/experiment/study/painted_study.h"

using namespace overt;
using namespace overt::test;

namespace {

/// The ball of a PaintedStudy (its object 0, vertices of radius 100) and an egg of the same triangles, twice
/// as wide, half as high, shifted, and modelled in centimetres. Trials of level "rough" show the egg.
struct BallAndEgg {
    PaintedStudy painted;
    ReadStudy study;
    StudyOptions options;
    static constexpr double to_mm = 10.0;

    static glm::dvec3 on_egg(const glm::dvec3& on_ball) {
        return (glm::dvec3(2.0, 1.0, 0.5) * on_ball + glm::dvec3(30.0, 0.0, -7.0)) / to_mm;
    }

    explicit BallAndEgg(const PaintedStudy::Look& look =
                            [](int, int level, RandomStream& random) {
                                return near(level == 0 ? front : top, 0.3, random);
                            })
        : painted(3, 2, 6, look) {
        study.results = std::move(painted.results);
        study.surfaces = std::move(painted.surfaces);
        options = painted.options;
        options.onto.object = "ball";
        options.onto.lists = {"face"};
        StudyResults& results = study.results;
        StudyObject egg = results.objects[0];
        egg.id = "egg";
        auto mesh = std::make_shared<Mesh>(*egg.mesh);
        for (glm::vec3& position : mesh->positions)
            position = glm::vec3(on_egg(glm::dvec3(position)));
        egg.mesh = mesh;
        egg.mm_per_unit = to_mm;
        egg.seconds_visible.assign(mesh->positions.size(), 2.0f);
        results.objects.push_back(std::move(egg));
        ObjectSurface& surface = study.surfaces.emplace_back();
        surface.geometry = std::make_unique<SurfaceGeometry>(*mesh, to_mm);
        surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
        surface.scale = ObjectScale{to_mm, 1000.0, 30.0};
        for (ObjectSurface& of : study.surfaces)
            of.pixel_seconds.assign(mesh->positions.size(), 1.0);
        study.surfaces[1].pixel_seconds.assign(mesh->positions.size(), 3.0);
        for (StudyTrial& trial : results.trials)
            trial.object = trial.key("material") == "rough" ? 1 : 0;
        for (StudyFixation& fixation : results.fixations) {
            if (results.trials[static_cast<std::size_t>(fixation.trial)].object == 1)
                fixation.position = position_of(*mesh, SurfaceSite{*fixation.triangle, fixation.barycentric});
            fixation.spread_mm = 4.0;
            fixation.cone_mm = 6.0;
            fixation.lut_mm = 0.5;
        }
        int number = 0;
        for (const glm::dvec3& towards :
             {front, back, top, -top, glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0)}) {
            const std::string name = fmt::format("face.{}", ++number);
            results.objects[0].points.push_back({name, 100.0 * towards});
            results.objects[1].points.push_back({name, on_egg(100.0 * towards)});
        }
    }

    void bring() { bring_to_template(study, options); }
    std::string refused() {
        try {
            bring();
            return {};
        } catch (const InputError& error) {
            return error.what();
        }
    }
};

} // namespace

TEST_CASE("each fixation comes to its own place of the template, with its lengths as much longer", "[unit]") {
    BallAndEgg of;
    const std::vector<StudyFixation> before = of.study.results.fixations;
    std::vector<int> shown;
    for (const StudyTrial& trial : of.study.results.trials)
        shown.push_back(trial.object);
    of.bring();
    const StudyResults& results = of.study.results;
    // The egg is 2 x 1 x 0.5 balls, so the ball is as large as it on the whole.
    for (std::size_t i = 0; i < before.size(); ++i) {
        const StudyFixation& fixation = results.fixations[i];
        const bool was_on_egg = shown[static_cast<std::size_t>(fixation.trial)] == 1;
        const Mesh& ball = *results.objects[0].mesh;
        const glm::dvec3 wanted = position_of(ball, SurfaceSite{*before[i].triangle, before[i].barycentric});
        INFO(i << (was_on_egg ? " egg" : " ball"));
        CHECK(glm::distance(fixation.position, wanted) < 1e-4);
        CHECK(glm::distance(position_of(ball, SurfaceSite{*fixation.triangle, fixation.barycentric}),
                            wanted) < 1e-4);
        CHECK(fixation.part == ball.triangle_parts[*fixation.triangle]);
        CHECK(fixation.sigma_mm == Approx(30.0).epsilon(1e-6));
    }
    CHECK(std::ranges::all_of(results.trials, [](const StudyTrial& trial) { return trial.object == 0; }));
    REQUIRE(results.template_fits.size() == 2);
    const TemplateFitRow &own = results.template_fits[0], &egg = results.template_fits[1];
    CHECK(own.object == 0);
    CHECK(own.warp == "the same surface");
    CHECK(own.landmarks == 0);
    CHECK(own.fixations == 18);
    CHECK_FALSE(own.gaze_away_mm);
    CHECK(egg.object == 1);
    CHECK(egg.warp == "thin plate");
    CHECK(egg.landmarks == 6);
    CHECK(egg.fixations == 18);
    CHECK(egg.scale == Approx(1.0).epsilon(1e-9));
    CHECK(egg.left_out_mm.value() < 1e-9);
    CHECK(egg.away_mm < 1e-4);
    CHECK(egg.gaze_away_mm.value() < 1e-4);
    CHECK(egg.turned_share == 0.0);
    CHECK(results.remarks.front().starts_with("All places are on ball. Those on others were brought to it: "
                                              "egg (by 6 landmarks, of which each is told "
                                              "by the others to "));
}

TEST_CASE("lengths of an object twice as large are halved, but for a kernel in millimetres", "[unit]") {
    for (const bool in_mm : {false, true}) {
        BallAndEgg of;
        for (NamedPlace& point : of.study.results.objects[1].points) {
            // A ball of 200 mm in place of the egg.
            const auto same =
                std::ranges::find(of.study.results.objects[0].points, point.name, &NamedPlace::name);
            point.position = 2.0 * same->position / BallAndEgg::to_mm;
        }
        auto ball = std::make_shared<Mesh>(*of.study.results.objects[0].mesh);
        for (glm::vec3& position : ball->positions)
            position *= 0.2f;
        of.study.results.objects[1].mesh = ball;
        of.options.sigma.is_mm = in_mm;
        of.bring();
        for (const StudyFixation& fixation : of.study.results.fixations) {
            const bool was_large =
                of.study.results.trials[static_cast<std::size_t>(fixation.trial)].key("material") == "rough";
            CHECK(fixation.sigma_mm == Approx(was_large && !in_mm ? 15.0 : 30.0));
            CHECK(fixation.mm_per_deg == Approx(was_large ? 15.0 : 30.0));
            CHECK(*fixation.spread_mm == Approx(was_large ? 2.0 : 4.0));
            CHECK(*fixation.cone_mm == Approx(was_large ? 3.0 : 6.0));
            CHECK(*fixation.lut_mm == Approx(was_large ? 0.25 : 0.5));
        }
        CHECK(of.study.results.template_fits[1].scale == Approx(0.5));
    }
}

TEST_CASE("what was visible is the mean over trials that count, each by its object", "[unit]") {
    BallAndEgg of;
    // Of the egg one trial counts, of the ball three.
    int left_out = 0;
    for (StudyTrial& trial : of.study.results.trials)
        trial.excluded = trial.object == 1 && left_out++ < 2;
    of.bring();
    const StudyObject& ball = of.study.results.objects[0];
    for (const float seconds : ball.seconds_visible)
        CHECK(seconds == Approx(0.75 * 8.0 + 0.25 * 2.0));
    double pixels = 0.0;
    for (const double one : of.study.surfaces[0].pixel_seconds) {
        CHECK(one == Approx(0.75 * 1.0 + 0.25 * 3.0).epsilon(1e-4));
        pixels += one;
    }
    // Rows are of the template alone: all of it, and its two areas, which hold all.
    const std::vector<ExposureRow>& rows = of.study.results.exposures;
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].area.empty());
    CHECK(rows[0].never_visible == 0.0);
    CHECK(rows[0].seconds_visible == Approx(6.5));
    CHECK(rows[0].share_of_exposure == 1.0);
    CHECK_FALSE(rows[0].foreshortening);
    CHECK(rows[1].share_of_exposure + rows[2].share_of_exposure == Approx(1.0));
    CHECK(rows[1].share_of_exposure > rows[2].share_of_exposure);
    CHECK(std::ranges::all_of(rows, [](const ExposureRow& row) { return row.object == 0; }));
    CHECK(of.study.results.objects[1].areas.empty());
}

TEST_CASE("a place stays in its areas where the template has them, and evidence goes by their names",
          "[unit]") {
    BallAndEgg of(
        [](int, int level, RandomStream& random) { return near(level == 0 ? front : top, 0.8, random); });
    StudyResults& results = of.study.results;
    // The ball's head is smaller than the egg's, and the names come in another order.
    auto ball = std::make_shared<Mesh>(*results.objects[0].mesh);
    ball->part_names = {"head", "crown/head", "body"};
    for (std::size_t t = 0; t < ball->triangles.size(); ++t) {
        const float z = ball->positions[ball->triangles[t].x].z;
        ball->triangle_parts[t] = z > 95.0f ? 1 : z > 85.0f ? 0 : 2;
    }
    results.objects[0].mesh = ball;
    results.objects[0].part_names = ball->part_names;
    results.objects[0].areas = Areas(ball->part_names);
    for (StudyFixation& fixation : results.fixations)
        fixation.evidence = {{0.25, 0.5}, {0.75, 0.125}}; // body, head
    const std::vector<StudyFixation> before = results.fixations;
    std::vector<int> was_head;
    for (const StudyFixation& fixation : before)
        was_head.push_back(fixation.part == 1);
    of.bring();
    int heads = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const StudyFixation& fixation = results.fixations[i];
        if (results.trials[static_cast<std::size_t>(fixation.trial)].key("material") != "rough")
            continue; // its own surface
        // Both know "head" and "body", so a head is a head, whether it lies in the crown or not.
        CHECK((fixation.part == 2) == (was_head[i] == 0));
        heads += was_head[i];
        REQUIRE(fixation.evidence.size() == 3); // head, crown, body
        const auto evidence = [&](const char* area) {
            return fixation.evidence[*results.objects[0].areas.find(area)];
        };
        CHECK(evidence("head").inside == 0.75);
        CHECK(evidence("body").elsewhere == 0.5);
        CHECK_FALSE(evidence("crown").tells());
    }
    CHECK(heads > 5);
    CHECK(results.template_fits[1].gaze_away_mm.value() > 0.5);
}

TEST_CASE("places that were pointed at are brought, too", "[unit]") {
    BallAndEgg of;
    StudyResults& results = of.study.results;
    for (const int object : {0, 1}) {
        AnsweredPointRow& row = results.points.given.emplace_back();
        row.of.object = object;
        row.triangle = 100;
        row.barycentric = {0.5, 0.25, 0.25};
        row.place = position_of(*results.objects[static_cast<std::size_t>(object)].mesh,
                                SurfaceSite{100, row.barycentric});
        row.largest_sd = object == 0 ? 3.0 : 0.3;
    }
    results.points.given.emplace_back().of.object = 1; // beside the object
    of.bring();
    const std::vector<AnsweredPointRow>& given = results.points.given;
    CHECK(glm::distance(given[0].place.value(), given[1].place.value()) < 1e-4);
    CHECK(given[1].triangle == 100u);
    CHECK(given[1].part_name == results.objects[0].part_names[given[1].part.value()]);
    CHECK(given[1].largest_sd.value() == Approx(3.0));
    CHECK_FALSE(given[2].place);
    CHECK(std::ranges::all_of(given, [](const AnsweredPointRow& row) { return row.of.object == 0; }));
}

TEST_CASE("landmarks of a table, or the middles of areas, stand in for lists", "[unit]") {
    BallAndEgg of;
    of.options.onto.lists.clear();
    of.options.onto.file = "faces.csv";
    for (const NamedPlace& point : of.study.results.objects[0].points) {
        of.options.onto.landmarks.push_back({"ball", point.name, point.position});
        of.options.onto.landmarks.push_back({"egg", point.name, 2.0 * point.position});
    }
    of.options.onto.landmarks.push_back({"egg", "alone", {1, 2, 3}});
    of.bring();
    CHECK(of.study.results.template_fits[1].landmarks == 6);
    CHECK(of.study.results.template_fits[1].scale == Approx(0.5));

    BallAndEgg by_areas;
    by_areas.options.onto.lists.clear();
    CHECK(by_areas.refused() ==
          "--template ball: of the middles of the areas of egg and the template ball, 1 of them corresponds: "
          "it "
          "takes three at least, and four that do not lie in a plane for a warp that bends");
    BallAndEgg of_four;
    of_four.options.onto.lists.clear();
    for (StudyObject& object : of_four.study.results.objects) {
        auto mesh = std::make_shared<Mesh>(*object.mesh);
        mesh->part_names = {"body", "front", "left", "top", "right"};
        const Mesh& ball = *by_areas.study.results.objects[0].mesh;
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
            const glm::vec3& at = ball.positions[ball.triangles[t].x];
            mesh->triangle_parts[t] = at.y < -60 ? 1 : at.x < -60 ? 2 : at.z > 60 ? 3 : at.x > 60 ? 4 : 0;
        }
        object.part_names = mesh->part_names;
        object.areas = Areas(mesh->part_names);
        object.mesh = mesh;
    }
    of_four.bring();
    CHECK(of_four.study.results.template_fits[1].landmarks == 4);
    // Of an affine egg the middles by area lie a little beside those of the ball.
    CHECK(of_four.study.results.template_fits[1].away_mm < 12.0);
    CHECK(of_four.study.results.template_fits[1].away_mm > 0.01);
}

TEST_CASE("a template that cannot be is refused, and without one nothing happens", "[unit]") {
    BallAndEgg unknown;
    unknown.options.onto.object = "bowl";
    CHECK(unknown.refused() ==
          "--template bowl: no object of these sessions is called so; there are ball, egg");
    BallAndEgg few;
    few.options.onto.lists = {"ears"};
    CHECK(few.refused().starts_with(
        "--landmarks ears: of the landmarks of egg and the template ball, 0 of them"));
    BallAndEgg bare;
    bare.study.results.objects[1].mesh = nullptr;
    CHECK(
        bare.refused() ==
        "--template ball: egg has no mesh in these sessions, or its size is not known, so that places on it "
        "belong nowhere else: leave out the sessions that show it");
    BallAndEgg swapped;
    std::swap(swapped.study.results.objects[1].points[4].position,
              swapped.study.results.objects[1].points[5].position);
    CHECK(swapped.refused().ends_with("were exchanged on one of both"));
    BallAndEgg alone;
    alone.options.onto.object.clear();
    alone.bring();
    CHECK(alone.study.results.template_fits.empty());
    CHECK(alone.study.results.trials.back().object == 1);
}

TEST_CASE("how far a surface lies from the template, and what of it faces the other way, is said by area",
          "[unit]") {
    // Landmarks that say that nothing moves, on a ball that is 10 mm larger.
    BallAndEgg larger;
    auto mesh = std::make_shared<Mesh>(*larger.study.results.objects[0].mesh);
    for (glm::vec3& position : mesh->positions)
        position *= 1.1f / static_cast<float>(BallAndEgg::to_mm);
    larger.study.results.objects[1].mesh = mesh;
    for (NamedPlace& point : larger.study.results.objects[1].points)
        point.position =
            std::ranges::find(larger.study.results.objects[0].points, point.name, &NamedPlace::name)
                ->position /
            BallAndEgg::to_mm;
    larger.bring();
    const TemplateFitRow& away = larger.study.results.template_fits[1];
    CHECK(away.scale == Approx(1.0));
    CHECK(away.away_mm == Approx(10.0).epsilon(0.02)); // triangles are flat
    CHECK(away.gaze_away_mm.value() == Approx(10.0).epsilon(0.02));
    CHECK(away.turned_share == 0.0);

    // A quarter of the egg is inside out: above, on the right.
    BallAndEgg turned;
    auto flipped = std::make_shared<Mesh>(*turned.study.results.objects[1].mesh);
    double area = 0.0, inside_out = 0.0;
    for (std::size_t t = 0; t < flipped->triangles.size(); ++t) {
        const Mesh& ball = *turned.study.results.objects[0].mesh;
        const glm::uvec3& of = ball.triangles[t];
        const glm::vec3 middle = (ball.positions[of.x] + ball.positions[of.y] + ball.positions[of.z]) / 3.0f;
        const double own = glm::length(glm::cross(ball.positions[of.y] - ball.positions[of.x],
                                                  ball.positions[of.z] - ball.positions[of.x]));
        area += own;
        if (middle.x > 0.0f && middle.z > 0.0f) {
            std::swap(flipped->triangles[t].y, flipped->triangles[t].z);
            inside_out += own;
        }
    }
    turned.study.results.objects[1].mesh = flipped;
    turned.bring();
    CHECK(turned.study.results.template_fits[1].turned_share == Approx(inside_out / area).epsilon(1e-3));
    const std::string said =
        fmt::format("{:.0f} % of the surface of egg come to lie on a part of ball that faces "
                    "the other way",
                    100.0 * inside_out / area);
    CHECK(std::ranges::any_of(turned.study.results.remarks,
                              [&](const std::string& remark) { return remark.starts_with(said); }));
}

TEST_CASE("exposure is counted to the part that a vertex's first triangle has", "[unit]") {
    BallAndEgg of;
    const Mesh& ball = *of.study.results.objects[0].mesh;
    std::vector<double> pixels(ball.positions.size(), 1.0), parts(2, 0.0);
    std::vector<bool> is_counted(ball.positions.size());
    for (std::size_t v = 0; v < pixels.size(); ++v)
        pixels[v] = ball.positions[v].z > 70.0f ? 5.0 : 0.5;
    for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = ball.triangles[t][corner];
            if (!is_counted[v])
                parts[ball.triangle_parts[t]] += pixels[v];
            is_counted[v] = true;
        }
    }
    for (ObjectSurface& surface : of.study.surfaces)
        surface.pixel_seconds = pixels;
    of.bring();
    for (const ExposureRow& row : of.study.results.exposures)
        if (row.area == "head")
            CHECK(row.share_of_exposure == Approx(parts[1] / (parts[0] + parts[1])).epsilon(0.02));
}

TEST_CASE("where the template has no place in all areas of a fixation, the nearest of all is taken",
          "[unit]") {
    BallAndEgg of;
    StudyResults& results = of.study.results;
    const auto rename = [&](std::size_t object, const std::vector<std::string>& names) {
        auto mesh = std::make_shared<Mesh>(*results.objects[object].mesh);
        mesh->part_names = names;
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
            mesh->triangle_parts[t] = mesh->triangle_parts[t] == 1 && names.size() > 2 && t % 2 == 1
                                          ? PartIndex{2}
                                          : mesh->triangle_parts[t];
        results.objects[object].mesh = mesh;
        results.objects[object].part_names = names;
        results.objects[object].areas = Areas(names);
    };
    rename(0, {"body", "head", "face"}); // beside each other
    rename(1, {"body", "head/face"});
    const std::vector<StudyFixation> before = results.fixations;
    of.bring();
    for (std::size_t i = 0; i < before.size(); ++i) {
        const glm::dvec3 wanted =
            position_of(*results.objects[0].mesh, SurfaceSite{*before[i].triangle, before[i].barycentric});
        CHECK(glm::distance(results.fixations[i].position, wanted) < 1e-4);
    }
}
