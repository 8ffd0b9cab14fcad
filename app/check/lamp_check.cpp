#include "app/check/lamp_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "experiment/protocol/all_stimuli.h"
#include "experiment/scene/mesh_topology.h"
#include "experiment/scene/ray_caster.h"
#include "render/bake/light_sources.h"

namespace overt {

namespace {

constexpr int lines_over_lamp = 20; // each way over a flat lamp

bool is_cut(const RayCaster& surface, glm::dvec3 from, glm::dvec3 to) {
    const double length = glm::length(to - from);
    if (!(length > 0.0))
        return false;
    const auto hit = surface.first_hit({from, (to - from) / length});
    return hit && hit->distance <= length;
}

bool cuts_sphere(const LightSource& lamp, const RayCaster& surface) {
    // Even over the sphere, by the golden angle.
    constexpr int spokes = lines_over_lamp * lines_over_lamp;
    const glm::dvec3 middle(lamp.place);
    for (int i = 0; i < spokes; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / spokes, out = std::sqrt(1.0 - z * z);
        const double around = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const glm::dvec3 spoke(out * std::cos(around), out * std::sin(around), z);
        if (is_cut(surface, middle, middle + static_cast<double>(lamp.radius) * spoke))
            return true;
    }
    return false;
}

bool cuts_flat(const LightSource& lamp, const RayCaster& surface) {
    const bool is_disc = lamp.shape == LightSource::Shape::disc;
    const glm::dvec3 middle(lamp.place), across(lamp.across),
        up = glm::cross(glm::dvec3(lamp.facing), across);
    const double half_width = static_cast<double>(is_disc ? lamp.radius : lamp.half_width),
                 half_height = static_cast<double>(is_disc ? lamp.radius : lamp.half_height);
    for (int i = 0; i < lines_over_lamp; ++i) {
        const double share = (2.0 * i + 1.0) / lines_over_lamp - 1.0,
                     left = is_disc ? std::sqrt(1.0 - share * share) : 1.0;
        const glm::dvec3 level = middle + share * half_height * up,
                         upright = middle + share * half_width * across;
        if (is_cut(surface, level - left * half_width * across, level + left * half_width * across) ||
            is_cut(surface, upright - left * half_height * up, upright + left * half_height * up))
            return true;
    }
    return false;
}

bool is_inside(glm::dvec3 place, const Mesh& mesh, const RayCaster& surface) {
    // What is met first from within is met from behind; three lines, since one may run along an edge.
    int from_behind = 0;
    for (const glm::dvec3 direction :
         {glm::dvec3(0.48, 0.6, 0.64), glm::dvec3(-0.8, 0.36, 0.48), glm::dvec3(0.28, -0.576, -0.768)}) {
        const auto hit = surface.first_hit({place, direction});
        if (!hit)
            return false;
        const glm::uvec3 corners = mesh.triangles[hit->triangle];
        const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
            c(mesh.positions[corners.z]);
        from_behind += glm::dot(glm::cross(b - a, c - a), direction) > 0.0 ? 1 : 0;
    }
    return from_behind >= 2;
}

/// Some of a motion's frames, evenly over all.
std::vector<AnimationFrameIndex> looked_at(const MotionSettings& motion) {
    constexpr int most = 72;
    std::vector<AnimationFrameIndex> frames;
    const int count = std::min(most, motion.frame_count);
    for (int i = 0; i < count; ++i)
        frames.push_back({i * motion.frame_count / count});
    return frames;
}

/// A light's lamps, with those of the lights that it is the sum of.
std::vector<std::pair<LampSettings, LightSource>> lamps_of(const LightSettings& light) {
    std::vector<std::pair<LampSettings, LightSource>> lamps;
    const auto add = [&](const LightSettings& one) {
        LightSettings of_lamps = one;
        of_lamps.sun_lux.reset();
        std::vector<LightSource> sources =
            moved(light_sources(of_lamps),
                  glm::dmat3(glm::rotate(glm::dmat4(1.0), to_radians({one.rotation_deg}).value,
                                         glm::dvec3(0, 0, 1))),
                  glm::dvec3(0.0));
        for (std::size_t i = 0; i < sources.size(); ++i)
            lamps.emplace_back(of_lamps.shining[i], sources[i]);
    };
    add(light);
    for (const LightSettings& part : light.parts)
        add(part);
    return lamps;
}

} // namespace

Enclosure::Enclosure(const Mesh& of)
    : mesh(&of), surface(of), has_inside(count_edges(of.triangles, of.positions.size()).bounds_volume()) {}

LampPlace place_of_lamp(const LightSource& lamp, const Enclosure& enclosure) {
    const RayCaster& surface = enclosure.surface;
    if (lamp.shape == LightSource::Shape::sphere ? cuts_sphere(lamp, surface) : cuts_flat(lamp, surface))
        return LampPlace::cutting;
    return enclosure.has_inside && is_inside(glm::dvec3(lamp.place), *enclosure.mesh, surface)
               ? LampPlace::inside
               : LampPlace::outside;
}

void check_lamps(const Experiment& experiment, Diagnostics& diagnostics) {
    const Protocol& protocol = experiment.protocol;
    std::map<const Mesh*, Enclosure> enclosures;
    std::set<std::tuple<int, int, int>> looked; // object, light and motion
    std::set<std::pair<int, std::string>> said; // object and lamp
    for (const Stimulus& stimulus : all_stimuli(protocol)) {
        const Object& object = experiment.objects[static_cast<std::size_t>(stimulus.object)];
        if (!object.has_mesh() || !looked.insert({stimulus.object, stimulus.light, stimulus.motion}).second)
            continue;
        const auto lamps = lamps_of(protocol.light_of(stimulus));
        if (lamps.empty())
            continue;
        const Mesh& mesh = object.mesh;
        const Enclosure& enclosure = enclosures.try_emplace(&mesh, mesh).first->second;
        const glm::dvec3 centre = mesh.bounds().centre();
        const MotionSettings& motion = protocol.motion_of(stimulus);
        for (const AnimationFrameIndex frame : looked_at(motion)) {
            const Pose pose = motion.pose_of(frame);
            const glm::dmat3 object_from_world =
                glm::transpose(glm::dmat3(TurntablePose{glm::dvec3(0.0), pose.object}.world_from_object()));
            const glm::dmat3 turned(
                glm::rotate(glm::dmat4(1.0), to_radians(pose.light).value, glm::dvec3(0, 0, 1)));
            for (const auto& [settings, source] : lamps) {
                if (said.contains({stimulus.object, settings.id}))
                    continue;
                const LightSource lamp = moved(std::span(&source, 1), object_from_world * turned,
                                               centre - object_from_world * pose.object.shift)
                                             .front();
                const LampPlace place = place_of_lamp(lamp, enclosure);
                if (place == LampPlace::outside)
                    continue;
                said.insert({stimulus.object, settings.id});
                const auto at = std::ranges::find(protocol.lamps, settings.id, &LampSettings::id);
                const auto index = at - protocol.lamps.begin();
                diagnostics.warning(
                    protocol.file.string(), protocol.places.of(fmt::format("lamp[{}].position", index)),
                    fmt::format("lamp \"{}\" of light \"{}\" {} object \"{}\"{}", settings.id,
                                protocol.light_of(stimulus).id,
                                place == LampPlace::inside ? "stands inside" : "cuts through", object.id,
                                motion.frame_count > 1 ? fmt::format(" in frame {}", frame.value) : ""),
                    place == LampPlace::inside
                        ? "its light stays within, unless the object is of glass: move it out"
                        : "what is within shines through no surface, and the rest from nowhere: move it "
                          "away");
            }
        }
    }
}

} // namespace overt
