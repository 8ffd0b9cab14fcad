#include "render/stimulus/frame_key.h"

#include <functional>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "render/stimulus/frame_quality.h"
#include "tests/support/figures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

/// All that a frame comes from, to be changed.
struct Inputs {
    Object object;
    MaterialSettings material;
    LightSettings light;
    BakeSettings settings;
    StandardObserver observer = StandardObserver::cie1931;
    int view = 0;
    Degrees light_turn;

    ContentHash key() const {
        return traced_key(object, view, material, hash_of_surroundings(Surroundings(light), light_turn),
                          light.exposure, settings, observer);
    }
    ContentHash key_live() const {
        return live_key(object, view, material, hash_of_surroundings(Surroundings(light), {}), light_turn,
                        light.exposure);
    }
};

LampSettings& with_lamp(Inputs& inputs) {
    LampSettings& lamp = inputs.light.shining.emplace_back();
    inputs.light.lamps = {"lamp"};
    lamp.id = "lamp";
    lamp.cd_m2 = 10.0;
    lamp.radius = 0.5;
    lamp.position = glm::dvec3(1.0, 2.0, 3.0);
    return lamp;
}

LightSettings& with_sum(Inputs& inputs) {
    inputs.light.sum = {{"a", 1.0}, {"b", 0.5}};
    inputs.light.parts = std::vector<LightSettings>(2);
    inputs.light.parts[0].probe = "gallery";
    return inputs.light;
}

Inputs some_inputs() {
    Inputs inputs;
    inputs.object.mesh = bust();
    inputs.object.mesh_hash = hash_of_mesh(inputs.object.mesh);
    inputs.object.scenes.resize(2);
    inputs.object.scenes[1].view.camera.position = {0.0, -2.0, 1.0};
    return inputs;
}

} // namespace

TEST_CASE("whatever makes a traced frame changes its key, and nothing else does", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path probe = folder.file("probe.exr", "one"), metal = folder.file("m.csv", "one");
    const std::map<std::string, std::function<void(Inputs&)>> changes{
        {"mesh", [](Inputs& i) { i.object.mesh_hash = "other"; }},
        {"camera", [](Inputs& i) { i.object.scenes[0].view.camera.position.x += 1e-9; }},
        {"target", [](Inputs& i) { i.object.scenes[0].view.camera.target.z += 1e-9; }},
        {"field of view", [](Inputs& i) { i.object.scenes[0].view.camera.vertical_fov.value += 1e-9; }},
        {"size", [](Inputs& i) { i.object.scenes[0].view.image_px.y += 1; }},
        {"kind", [](Inputs& i) { i.material.kind = MaterialKind::diffuse; }},
        {"metal", [](Inputs& i) { i.material.metal = "Ag"; }},
        {"roughness", [](Inputs& i) { i.material.roughness = 0.1301; }},
        {"index", [](Inputs& i) { i.material.coat_ior *= 1.001; }},
        {"absorbance", [](Inputs& i) { i.material.coat_absorbance[2] *= 1.001; }},
        {"thickness", [](Inputs& i) { i.material.coat_thickness *= 1.001; }},
        {"width of bumps", [](Inputs& i) { i.material.coat_bump_width *= 1.001; }},
        {"other bumps", [](Inputs& i) { i.material.coat_seed += 1; }},
        {"bumps", [](Inputs& i) { i.material.coat_bump *= 1.001; }},
        {"reflectance", [](Inputs& i) { i.material.reflectance = glm::dvec3(0.5005, 0.5, 0.5); }},
        {"base",
         [](Inputs& i) {
             i.material.kind = MaterialKind::diffuse;
             i.material.base = MaterialBase::own;
         }},
        {"own", [](Inputs& i) { i.material.kind = MaterialKind::own; }},
        {"own of another look",
         [](Inputs& i) {
             i.material.kind = MaterialKind::own;
             i.object.appearance_hash = "other";
         }},
        {"own, with a roughness of its own",
         [](Inputs& i) {
             i.material.kind = MaterialKind::own;
             i.material.roughness = 0.13; // what stands there where nothing is given
         }},
        {"own, with a metal of its own",
         [](Inputs& i) {
             i.material.kind = MaterialKind::own;
             i.material.metallic = 0.0;
         }},
        {"own, with a colour of its own",
         [](Inputs& i) {
             i.material.kind = MaterialKind::own;
             i.material.reflectance = glm::dvec3(0.5);
         }},
        {"own, of one of the file's materials",
         [](Inputs& i) {
             i.material.kind = MaterialKind::own;
             i.material.roughness = 0.13;
             i.material.of = {"glaze"};
         }},
        {"own without bumps",
         [](Inputs& i) {
             i.material.kind = MaterialKind::own;
             i.material.bumps = MaterialBumps::none;
         }},
        {"the file's bumps", [](Inputs& i) { i.material.bumps = MaterialBumps::own; }},
        {"plastic under a coat",
         [](Inputs& i) {
             i.material.kind = MaterialKind::plastic;
             i.material.clear_coat = 0.5;
         }},
        {"rough metal", [](Inputs& i) { i.material.kind = MaterialKind::rough_conductor; }},
        {"rough metal under a coat",
         [](Inputs& i) {
             i.material.kind = MaterialKind::rough_conductor;
             i.material.clear_coat = 0.5;
         }},
        {"rough metal under a rough coat",
         [](Inputs& i) {
             i.material.kind = MaterialKind::rough_conductor;
             i.material.clear_coat = 0.5;
             i.material.clear_coat_roughness = 0.1;
         }},
        {"glass", [](Inputs& i) { i.material.kind = MaterialKind::glass; }},
        {"rough glass",
         [](Inputs& i) {
             i.material.kind = MaterialKind::glass;
             i.material.roughness = 0.13;
         }},
        {"glass of an Abbe number",
         [](Inputs& i) {
             i.material.kind = MaterialKind::glass;
             i.material.abbe = 60.0;
         }},
        {"coloured glass",
         [](Inputs& i) {
             i.material.kind = MaterialKind::glass;
             i.material.absorbance[1] = 0.2;
         }},
        {"translucent", [](Inputs& i) { i.material.kind = MaterialKind::translucent; }},
        {"translucent under a rough surface",
         [](Inputs& i) {
             i.material.kind = MaterialKind::translucent;
             i.material.roughness = 0.13;
         }},
        {"translucent, scattering more",
         [](Inputs& i) {
             i.material.kind = MaterialKind::translucent;
             i.material.scattering_per_mm[0] *= 1.001;
         }},
        {"translucent, absorbing more",
         [](Inputs& i) {
             i.material.kind = MaterialKind::translucent;
             i.material.absorption_per_mm[2] *= 1.001;
         }},
        {"translucent, scattering forward",
         [](Inputs& i) {
             i.material.kind = MaterialKind::translucent;
             i.material.scattering_anisotropy = 0.5;
         }},
        {"translucent and denser",
         [](Inputs& i) {
             i.material.kind = MaterialKind::translucent;
             i.material.density = 1.001;
         }},
        {"film", [](Inputs& i) { i.material.film_nm = 300.0; }},
        {"index of the film",
         [](Inputs& i) {
             i.material.film_nm = 300.0;
             i.material.film_ior = 1.5;
         }},
        {"brushed",
         [](Inputs& i) {
             i.material.kind = MaterialKind::rough_conductor;
             i.material.anisotropy = 0.5;
         }},
        {"brushed upward",
         [](Inputs& i) {
             i.material.kind = MaterialKind::rough_conductor;
             i.material.anisotropy = 0.5;
             i.material.brushed = BrushedAlong::upward;
         }},
        {"dark", [](Inputs& i) { i.light.probe = "dark"; }},
        {"sun", [](Inputs& i) { i.light.sun_lux = 1000.0; }},
        {"unit of the sun",
         [](Inputs& i) {
             i.light.sun_lux = 1000.0;
             i.light.unit_cd_m2 = 2.0;
         }},
        {"azimuth",
         [](Inputs& i) {
             i.light.sun_lux = 1000.0;
             i.light.sun_azimuth_deg = 1.0;
         }},
        {"elevation",
         [](Inputs& i) {
             i.light.sun_lux = 1000.0;
             i.light.sun_elevation_deg = 46.0;
         }},
        {"radius of the sun",
         [](Inputs& i) {
             i.light.sun_lux = 1000.0;
             i.light.sun_radius_deg = 1.0;
         }},
        {"colour of the sun",
         [](Inputs& i) {
             i.light.sun_lux = 1000.0;
             i.light.sun_colour[2] = 0.9;
         }},
        {"lamp", [](Inputs& i) { with_lamp(i); }},
        {"luminance of the lamp", [](Inputs& i) { with_lamp(i).cd_m2 = 11.0; }},
        {"shape of the lamp", [](Inputs& i) { with_lamp(i).shape = LampShape::sphere; }},
        {"place of the lamp", [](Inputs& i) { with_lamp(i).position = glm::dvec3(1.0, 2.0, 3.1); }},
        {"where the lamp faces", [](Inputs& i) { with_lamp(i).faces = glm::dvec3(0.0, 0.0, 0.1); }},
        {"width of the lamp", [](Inputs& i) { with_lamp(i).width = 0.5; }},
        {"height of the lamp", [](Inputs& i) { with_lamp(i).height = 0.5; }},
        {"radius of the lamp", [](Inputs& i) { with_lamp(i).radius = 0.6; }},
        {"colour of the lamp", [](Inputs& i) { with_lamp(i).colour[0] = 0.6; }},
        {"sum", [](Inputs& i) { with_sum(i); }},
        {"share in the sum", [](Inputs& i) { with_sum(i).sum[1].second = 0.4; }},
        {"part of the sum", [](Inputs& i) { with_sum(i).parts[1].rotation_deg = 3.0; }},
        {"probe", [&](Inputs& i) { i.light.probe = probe.string(); }},
        {"gallery", [](Inputs& i) { i.light.probe = "gallery"; }},
        {"rotation", [](Inputs& i) { i.light.rotation_deg = 1.0; }},
        {"turn of the light", [](Inputs& i) { i.light_turn = {2.0}; }},
        {"view", [](Inputs& i) { i.view = 1; }},
        {"samples", [](Inputs& i) { i.settings.samples += 1; }},
        {"target error", [](Inputs& i) { i.settings.target_error_de = 0.5; }},
        {"filter", [](Inputs& i) { i.settings.filter = PixelFilter::gaussian; }},
        {"filter's width", [](Inputs& i) { i.settings.filter_width_px = 2.0; }},
        {"resolution", [](Inputs& i) { i.settings.pixel_step = 2; }},
        {"seed", [](Inputs& i) { i.settings.seed = 1; }},
        {"observer", [](Inputs& i) { i.observer = StandardObserver::cie2006; }},
        {"metal's file", [&](Inputs& i) { i.material.metal = metal.string(); }}};
    std::set<ContentHash> keys{some_inputs().key()};
    for (const auto& [what, change] : changes) {
        Inputs inputs = some_inputs();
        change(inputs);
        CAPTURE(what);
        CHECK(keys.insert(inputs.key()).second);
        CHECK(inputs.key() == inputs.key());
    }
    // Files count by what is in them.
    Inputs from_files = some_inputs();
    from_files.light.probe = probe.string();
    from_files.material.metal = metal.string();
    keys.insert(from_files.key());
    folder.file("probe.exr", "two");
    CHECK(keys.insert(from_files.key()).second);
    folder.file("m.csv", "two");
    CHECK(keys.insert(from_files.key()).second);

    Inputs same = some_inputs();
    same.light.exposure = 2.0;
    same.settings.most_threads = 1;
    same.material.id = same.material.title = "another name";
    same.object.id = "another name";
    same.object.appearance_hash = "of no account where no material asks for it";
    CHECK(same.key() == some_inputs().key());
    // Errors are judged in the light that is shown.
    Inputs judged = some_inputs();
    judged.settings.target_error_de = 0.5;
    const ContentHash before = judged.key();
    judged.light.exposure = 2.0;
    CHECK(judged.key() != before);
}

TEST_CASE("the exposure is in live frames, and they are no traced ones", "[unit]") {
    Inputs inputs = some_inputs();
    const ContentHash before = inputs.key_live();
    CHECK(before != inputs.key());
    inputs.light.exposure = 2.0;
    CHECK(inputs.key_live() != before);
}

TEST_CASE("a light that turns makes other frames and the same maps", "[unit]") {
    Inputs turned = some_inputs();
    turned.light_turn = {10.0};
    CHECK(turned.key() != some_inputs().key());
    CHECK(turned.key_live() != some_inputs().key_live());
    // A frame does not tell whether its light came there by a motion or stands there.
    Inputs standing = some_inputs();
    standing.light.rotation_deg = 10.0;
    CHECK(turned.key() == standing.key());
    const Inputs inputs = some_inputs();
    CHECK(map_key(inputs.object, 0) == map_key(turned.object, 0));
    CHECK(map_key(inputs.object, 0) != map_key(inputs.object, 1));
}

TEST_CASE("samples and target of a protocol belong to its own quality", "[unit]") {
    BakingSettings baking;
    baking.quality = BakeQuality::standard;
    baking.samples = 96;
    baking.target_error_de = 0.5;
    baking.seed = 5;
    CHECK(quality_of(BakeQuality::draft, baking) == FrameQuality{BakeQuality::draft, {}, {}});
    const FrameQuality own = quality_of(BakeQuality::standard, baking);
    CHECK(own == FrameQuality{BakeQuality::standard, 96, 0.5});
    const BakeSettings settings = bake_settings(own, baking, MaterialKind::smooth_conductor);
    CHECK(settings.samples == 96);
    CHECK(settings.target_error_de == 0.5);
    CHECK(settings.seed == 5);
    CHECK(bake_settings({BakeQuality::preview, {}, {}}, baking, MaterialKind::diffuse).pixel_step == 2);
}
