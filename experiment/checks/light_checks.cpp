#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"

namespace overt {

namespace {

std::string light_path(std::size_t index, std::string_view key) {
    return fmt::format("light[{}].{}", index, key);
}

void check_lamp(ProtocolExamination& examination, std::size_t index) {
    const LampSettings& lamp = examination.protocol.lamps[index];
    const auto path = [&](std::string_view key) { return fmt::format("lamp[{}].{}", index, key); };
    const std::string shape = path("shape"), entry = fmt::format("lamp[{}]", index);
    const auto needs = [&](std::string_view key, double value) {
        if (!(value > 0.0))
            examination.error({path(key), entry},
                              fmt::format("the {} \"{}\" has no {}", name_of(lamp.shape), lamp.id, key),
                              fmt::format("give its \"{}\", in the unit of the mesh", key));
    };
    const auto has_no = [&](std::string_view key) {
        if (examination.is_written(path(key)))
            examination.warning({path(key), shape},
                                fmt::format("\"{}\" has no effect on a {}", key, name_of(lamp.shape)));
    };
    if (lamp.shape == LampShape::rectangle) {
        needs("width", lamp.width);
        needs("height", lamp.height);
        has_no("radius");
    } else {
        needs("radius", lamp.radius);
        has_no("width");
        has_no("height");
    }
    if (lamp.shape == LampShape::sphere)
        has_no("faces");
    else if (lamp.position && *lamp.position == lamp.faces.value_or(glm::dvec3(0.0)))
        examination.error(
            {path("faces"), path("position")},
            fmt::format("the {} \"{}\" faces the very place that it stands at", name_of(lamp.shape), lamp.id),
            "\"faces\" is a place in front of it; without it, the centre of the object");
    if (lamp.colour == std::array{0.0, 0.0, 0.0})
        examination.error({path("colour")}, "a lamp of no colour gives no light", "white is [1, 1, 1]");
    if (std::ranges::none_of(examination.protocol.lights, [&](const LightSettings& light) {
            return std::ranges::find(light.lamps, lamp.id) != light.lamps.end();
        }))
        examination.warning({entry}, fmt::format("no light has the lamp \"{}\"", lamp.id),
                            fmt::format("lamps = [\"{}\"] below [[light]]", lamp.id));
}

/// What a light has besides its probe.
void check_sources(ProtocolExamination& examination, std::size_t index) {
    const LightSettings& light = examination.protocol.lights[index];
    std::vector<std::string_view> lamps;
    for (const LampSettings& lamp : examination.protocol.lamps)
        lamps.push_back(lamp.id);
    for (std::size_t i = 0; i < light.lamps.size(); ++i) {
        is_known(examination, light_path(index, "lamps"), "[[lamp]]", light.lamps[i], lamps);
        if (std::ranges::find(light.lamps.begin(), light.lamps.begin() + static_cast<std::ptrdiff_t>(i),
                              light.lamps[i]) != light.lamps.begin() + static_cast<std::ptrdiff_t>(i))
            examination.error({light_path(index, "lamps")},
                              fmt::format("the lamp \"{}\" stands there twice", light.lamps[i]),
                              "a brighter one has a higher luminance_cd_m2");
    }
    if (!light.sun_lux)
        for (const std::string_view key :
             {"sun_azimuth_deg", "sun_elevation_deg", "sun_radius_deg", "sun_colour"})
            if (examination.is_written(light_path(index, key)))
                examination.warning({light_path(index, key)},
                                    fmt::format("\"{}\" has no effect without \"sun_lux\"", key));
    if (light.sun_colour == std::array{0.0, 0.0, 0.0})
        examination.error({light_path(index, "sun_colour")}, "a sun of no colour gives no light",
                          "white is [1, 1, 1]");
    const std::string entry = fmt::format("light[{}]", index);
    if (light.has_sources() && light.probe != "dark" && !light.unit_cd_m2)
        examination.error(
            {light_path(index, light.sun_lux ? "sun_lux" : "lamps"), entry},
            fmt::format("nothing says how bright the probe of light \"{}\" is beside its sun "
                        "and lamps",
                        light.id),
            "unit_cd_m2 is the luminance that its 1 stands for: 5000, say, for an overcast sky; "
            "or probe = \"dark\"");
    if (!light.has_sources() && light.probe == "dark")
        examination.error({light_path(index, "probe"), entry},
                          fmt::format("there is no light in \"{}\": its probe is dark", light.id),
                          "add sun_lux or lamps");
}

void check_sum(ProtocolExamination& examination, std::size_t index) {
    const LightSettings& light = examination.protocol.lights[index];
    const std::string path = light_path(index, "sum");
    std::vector<std::string_view> others;
    for (const LightSettings& other : examination.protocol.lights)
        others.push_back(other.id);
    bool gives_light = false;
    for (const auto& [id, share] : light.sum) {
        gives_light = gives_light || share > 0.0;
        if (!is_known(examination, path, "[[light]]", id, others))
            continue;
        const auto other = std::ranges::find(examination.protocol.lights, id, &LightSettings::id);
        if (!other->sum.empty())
            examination.error({path},
                              id == light.id ? std::string("a light cannot be a part of itself")
                                             : fmt::format("\"{}\" is a sum itself", id),
                              "name the lights that it is made of");
    }
    if (!gives_light)
        examination.error({path}, "nothing of any light is in this sum", "give one a number above 0");
    for (const std::string_view key : {"probe", "rotation_deg", "unit_cd_m2", "sun_lux", "sun_azimuth_deg",
                                       "sun_elevation_deg", "sun_radius_deg", "sun_colour", "lamps"})
        if (examination.is_written(light_path(index, key)))
            examination.error({light_path(index, key), path},
                              fmt::format("\"{}\" has no place in a sum of lights", key),
                              "write it for one of the lights that the sum is of");
}

} // namespace

void check_lights(ProtocolExamination& examination) {
    std::vector<std::string_view> ids;
    for (const LampSettings& lamp : examination.protocol.lamps)
        ids.push_back(lamp.id);
    check_ids_differ(examination, "lamp", ids);
    for (std::size_t i = 0; i < examination.protocol.lamps.size(); ++i)
        check_lamp(examination, i);
    for (std::size_t i = 0; i < examination.protocol.lights.size(); ++i) {
        if (examination.protocol.lights[i].sum.empty())
            check_sources(examination, i);
        else
            check_sum(examination, i);
    }
}

} // namespace overt
