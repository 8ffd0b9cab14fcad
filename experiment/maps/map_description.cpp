#include "experiment/maps/map_description.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const glm::dvec3& vector) { return Json::array({vector.x, vector.y, vector.z}); }

/// A JSON object of a file, which knows where it stands in it for messages.
class Reader {
  public:
    Reader(const std::filesystem::path& file, const Json& object, std::string where = "")
        : file_(&file), object_(&object), where_(std::move(where)) {
        if (!object.is_object())
            refuse(where_.empty() ? "the file" : where_, "an object { … }");
    }

    /// The value of a key, or nothing if it is left out or null.
    const Json* find(const char* key) const {
        const auto found = object_->find(key);
        return found == object_->end() || found->is_null() ? nullptr : &*found;
    }
    std::optional<Reader> object(const char* key) const {
        const Json* value = find(key);
        return value ? std::optional<Reader>(std::in_place, *file_, *value, path(key)) : std::nullopt;
    }
    std::string text(const char* key) const {
        const Json* value = find(key);
        if (value && !value->is_string())
            refuse(path(key), "a text");
        return value ? value->get<std::string>() : "";
    }
    std::optional<double> number(const char* key) const {
        const Json* value = find(key);
        if (value && !value->is_number())
            refuse(path(key), "a number");
        return value ? std::optional(value->get<double>()) : std::nullopt;
    }
    std::optional<int> whole_number(const char* key) const {
        const Json* value = find(key);
        if (value && !value->is_number_integer())
            refuse(path(key), "a whole number");
        return value ? std::optional(value->get<int>()) : std::nullopt;
    }
    std::optional<glm::dvec3> vector(const char* key) const {
        const Json* value = find(key);
        if (!value)
            return std::nullopt;
        glm::dvec3 vector;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!value->is_array() || value->size() != 3 || !(*value)[axis].is_number())
                refuse(path(key), "a list of three numbers");
            vector[static_cast<int>(axis)] = (*value)[axis].get<double>();
        }
        return vector;
    }
    template <class Value> Value need(const char* key, const std::optional<Value>& value) const {
        if (!value)
            refuse(path(key), "given");
        return *value;
    }

  private:
    std::string path(const char* key) const { return where_.empty() ? key : where_ + "." + key; }
    [[noreturn]] void refuse(const std::string& what, const char* expected) const {
        throw InputError(fmt::format("{}: {} must be {}", file_->string(), what, expected));
    }

    const std::filesystem::path* file_;
    const Json* object_;
    std::string where_;
};

} // namespace

std::filesystem::path sidecar_of(const std::filesystem::path& map_file) {
    std::filesystem::path sidecar = map_file;
    return sidecar.replace_extension(".json");
}

Json to_json(const MapDescription& description) {
    Json json{{"what", "coordinate-encoded map: object coordinates of the surface at each pixel's centre"}};
    if (!description.object.empty())
        json["object"] = description.object;
    if (description.glass_index) {
        json["what"] = "coordinate-encoded map: object coordinates of the place where the line of sight "
                       "through each pixel's centre leaves the body of clear glass";
        json["glass_index"] = *description.glass_index;
    }
    if (description.frame)
        json["frame"] = *description.frame;
    if (description.angle)
        json["angle_deg"] = description.angle->value;
    if (description.size_px)
        json["size_px"] = {description.size_px->x, description.size_px->y};
    if (description.scale) {
        json["scale"] = *description.scale;
        json["coding"] = "code = round(scale * (x - min) / (max - min)), at most 65535, on each axis; red x, "
                         "green y, blue z, alpha coverage";
    }
    if (description.bounds)
        json["bounds"] = {{"min", json_of(description.bounds->min)},
                          {"max", json_of(description.bounds->max)}};
    if (!description.unit.empty())
        json["unit"] = description.unit;
    if (description.camera) {
        const Camera& camera = *description.camera;
        json["camera"] = {{"position", json_of(camera.position)},
                          {"target", json_of(camera.target)},
                          {"up", json_of({0.0, 0.0, 1.0})},
                          {"vertical_fov_deg", camera.vertical_fov.value}};
        if (camera.aside != 0.0)
            json["camera"]["aside"] = camera.aside;
    }
    if (!description.mesh_sha256.empty())
        json["mesh_sha256"] = description.mesh_sha256;
    json["convention"] = "right-handed, +z up; the object is turned counter-clockwise seen from above about "
                         "the vertical through the middle of its bounds, and its coordinates are those "
                         "before the turn; first row on top, pixel centres at +0.5; coverage is all or "
                         "nothing, pixels off the object are 0";
    return json;
}

std::optional<MapDescription> read_sidecar(const std::filesystem::path& file) {
    int error = 0;
    const std::optional<std::string> text = read_whole_file(file, most_text_bytes, error);
    if (!text)
        return std::nullopt;
    const Json json = Json::parse(*text, nullptr, false);
    if (json.is_discarded())
        throw InputError(fmt::format("{}: is no JSON", file.string()));
    const Reader reader(file, json);
    MapDescription description;
    description.object = reader.text("object");
    if (description.object.empty())
        description.object = reader.text("sculpture"); // of maps that earlier versions made
    description.unit = reader.text("unit");
    description.scale = reader.whole_number("scale");
    description.frame = reader.whole_number("frame");
    description.mesh_sha256 = reader.text("mesh_sha256");
    description.glass_index = reader.number("glass_index");
    if (const auto angle = reader.number("angle_deg"))
        description.angle = Degrees{*angle};
    if (const auto bounds = reader.object("bounds")) {
        description.bounds =
            Bounds{bounds->need("min", bounds->vector("min")), bounds->need("max", bounds->vector("max"))};
    }
    if (const auto camera = reader.object("camera")) {
        description.camera = Camera{camera->need("position", camera->vector("position")),
                                    camera->need("target", camera->vector("target")),
                                    {camera->need("vertical_fov_deg", camera->number("vertical_fov_deg"))},
                                    camera->number("aside").value_or(0.0)};
    }
    return description;
}

void write_sidecar(const std::filesystem::path& file, const MapDescription& description) {
    write_whole_file(file, to_json(description).dump(2) + '\n');
}

} // namespace overt
