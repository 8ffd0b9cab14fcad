#include "experiment/stimulus/object.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/scene/files/ply_writer.h"
#include "experiment/scene/making/flat_mesh.h"
#include "experiment/scene/ray_caster.h"
#include "experiment/scene/sculptures/novel_shapes.h"
#include "experiment/scene/sculptures/sculptures.h"
#include "experiment/scene/triangle_order.h"

namespace overt {

namespace {

/// Changes whenever an object comes out differently, so that an older one in the cache is not taken.
constexpr int sculpture_version = 1;

} // namespace

double mm_of_unit(std::string_view unit) {
    if (unit == "cm")
        return 10.0;
    if (unit == "m")
        return 1000.0;
    return unit == "in" ? 25.4 : 1.0;
}

std::string_view unit_of_lengths(const ObjectSettings& settings) {
    return settings.shipped.empty() && settings.unit == "own" ? "own" : "mm";
}

namespace {

MeshImport import_of(const ObjectSettings& settings) {
    MeshImport import;
    const bool is_gltf = is_gltf_name(settings.mesh);
    import.up = settings.up.empty() ? (is_gltf ? UpAxis::y : UpAxis::z) : up_axis_named(settings.up);
    const std::string_view own_unit = is_gltf ? "m" : "mm";
    import.scale = settings.scale * mm_of_unit(settings.unit.empty() ? own_unit : settings.unit);
    if (settings.parts_by)
        import.parts_by_material = *settings.parts_by == PartsBy::material;
    import.labels = settings.labels;
    import.weld_tolerance = settings.weld_tolerance;
    import.regions = area_regions(settings);
    return import;
}

Mesh shipped_sculpture(const std::string& name, const std::filesystem::path& cache) {
    const std::filesystem::path kept = cache / fmt::format("sculpture-{}-v{}.ply", name, sculpture_version);
    if (std::filesystem::exists(kept)) {
        MeshCleaningReport unused;
        return import_mesh(kept, {}, unused);
    }
    const std::optional<int> novel = novel_shape_number(name);
    Mesh mesh = novel ? make_novel_shape(*novel) : make_sculpture(name);
    order_for_drawing(mesh);
    std::filesystem::create_directories(cache);
    write_ply(kept, mesh);
    return mesh;
}

/// A camera that was fitted to the turns of a mesh, moved back until it also holds the mesh as it stands when
/// motions tilt or move it, with the same margin.
Camera moved_back(Camera camera, const Mesh& mesh, glm::ivec2 image_px, double margin,
                  std::span<const Animation* const> motions) {
    const double half_height = std::tan(0.5 * to_radians(camera.vertical_fov).value) * (1.0 - 2.0 * margin);
    const double half_width = half_height * image_px.x / image_px.y;
    const glm::dvec3 centre = mesh.bounds().centre();
    double distance = centre.y - camera.position.y;
    for (const Animation* motion : motions)
        for (const Pose& picture : motion->pictures()) {
            if (picture.object.is_turn())
                continue;
            const glm::dmat4 stands = TurntablePose{centre, picture.object}.world_from_object();
            for (const glm::vec3& position : mesh.positions) {
                const glm::dvec3 place = glm::dvec3(stands * glm::dvec4(position, 1.0)) - centre;
                distance = std::max(
                    distance,
                    std::max(std::abs(place.x) / half_width, std::abs(place.z) / half_height) - place.y);
            }
        }
    camera.position.y = centre.y - distance;
    return camera;
}

/// A camera before which a flat picture fills the image, as the observer sees it.
Camera camera_before_picture(const ObjectSettings& object, const Protocol& protocol) {
    const double distance_mm = protocol.display.viewing_distance_mm;
    const glm::dvec3 middle(0.5 * object.picture_mm.x, 0.0, 0.5 * object.picture_mm.y);
    return {middle - glm::dvec3(0.0, distance_mm, 0.0), middle,
            to_degrees({2.0 * std::atan(0.5 * object.picture_mm.y / distance_mm)})};
}

Camera camera_of(const ViewSettings& settings, const Protocol& protocol, const Mesh& mesh,
                 glm::dvec3 origin) {
    const glm::ivec2 image_px(settings.width_px, settings.height_px);
    const double mm_per_px = protocol.display.height_mm / protocol.display.height_px;
    // Seen from the observer's place, the picture then has the perspective of the object itself.
    const Degrees natural =
        to_degrees({2.0 * std::atan(0.5 * image_px.y * mm_per_px / protocol.display.viewing_distance_mm)});
    const Degrees field = settings.vertical_fov_deg ? Degrees{*settings.vertical_fov_deg} : natural;
    if (!settings.camera_position) {
        // One camera for all motions, so that they share maps.
        Degrees largest_turn{0.0};
        for (const Animation& motion : protocol.motions)
            largest_turn.value = std::max(largest_turn.value, motion.largest_turn().value);
        std::vector<const Animation*> moving;
        for (const Animation& motion : protocol.motions)
            if (!motion.only_turns())
                moving.push_back(&motion);
        const Camera fitted = fit_camera(mesh, field, image_px, largest_turn, settings.margin);
        return moving.empty() ? fitted : moved_back(fitted, mesh, image_px, settings.margin, moving);
    }
    return {*settings.camera_position - origin,
            settings.camera_target ? *settings.camera_target - origin : mesh.bounds().centre(), field};
}

} // namespace

std::vector<PartRegion> area_regions(const ObjectSettings& settings) {
    std::vector<PartRegion> regions;
    for (const AreaSettings& area : settings.areas) {
        PartRegion& region = regions.emplace_back(PartRegion{area.name, {}, {}, area.boxes, area.groups});
        for (const auto& [x, y, z, radius] : area.spheres)
            region.spheres.emplace_back(x, y, z, radius);
        for (const auto& plane : area.planes)
            region.half_spaces.push_back({{plane[0], plane[1], plane[2]}, {plane[3], plane[4], plane[5]}});
    }
    return regions;
}

std::vector<std::string> map_part_names(const ObjectSettings& settings) {
    OVERT_EXPECTS(settings.areas.size() <= most_map_areas);
    std::vector<std::string> names{std::string(rest_part)};
    for (const AreaSettings& area : settings.areas) {
        const std::size_t before = names.size();
        for (std::size_t part = 0; part < before; ++part)
            names.push_back(part == 0 ? area.name
                                      : fmt::format("{}{}{}", names[part], between_areas, area.name));
    }
    return names;
}

std::vector<std::string> areas_of(std::span<const Object> objects) {
    std::vector<std::string> areas;
    for (const Object& object : objects) {
        const Areas own(object.mesh->part_names);
        for (const std::string& area : own.names()) {
            if (std::ranges::find(areas, area) == areas.end())
                areas.push_back(area);
        }
    }
    return areas;
}

ContentHash hash_of_mesh(const Mesh& mesh) {
    ContentHasher hasher;
    hasher.add(mesh.positions).add(mesh.triangles).add(mesh.triangle_parts);
    for (const std::string& name : mesh.part_names)
        hasher.add(std::string_view(name));
    return hasher.finish();
}

namespace {

/// What a mesh is made of, with what the experimenter should know of it.
struct MadeMesh {
    SharedMesh mesh;
    ContentHash hash;
    glm::dvec3 origin{0.0};
    std::vector<std::string> remarks;
    std::shared_ptr<const SurfaceAppearance> appearance;
    ContentHash appearance_hash;
};

/// Whether a material of the protocol asks for how the object looks by its file.
bool asks_for_appearance(const Protocol& protocol) {
    return std::ranges::any_of(protocol.materials, &MaterialSettings::is_of_file);
}

std::string as_percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

/// What was read of each material of the file, a sentence each.
std::vector<std::string> look_remarks(const SurfaceAppearance& appearance, const Mesh& mesh) {
    std::vector<std::string> remarks = appearance.remarks;
    const std::vector<MeanLook> looks = mean_looks(appearance, mesh);
    double all = 0.0;
    for (const MeanLook& look : looks)
        all += look.area;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const auto& [look, area, largest, overexposed] = looks[i];
        if (!(area > 0.0))
            continue;
        const std::string name = appearance.materials.empty() ? "" : appearance.materials[i].name;
        const double mean = static_cast<double>(look.colour.x + look.colour.y + look.colour.z) / 3.0;
        remarks.push_back(fmt::format(
            "Surface {}, {} of the area: reflectance {:.2f} {:.2f} {:.2f} in the mean, {} metal, roughness "
            "{:.2f}{}.",
            name.empty() ? "without a name" : fmt::format("\"{}\"", name), as_percent(area / all),
            look.colour.x, look.colour.y, look.colour.z, as_percent(static_cast<double>(look.metallic)),
            look.roughness,
            !appearance.materials.empty() && appearance.materials[i].normal_picture.picture >= 0
                ? ", with a picture of bumps"
                : ""));
        if (mean > 0.9 || overexposed > 0.01)
            remarks.push_back(fmt::format(
                "Its colours are very bright, at the limit on {} of its area: a scan that was exposed to "
                "white, or a colour that was never set.",
                as_percent(overexposed)));
    }
    return remarks;
}

/// Whether two objects of a protocol are of one mesh, by what it says of them.
bool are_of_one_mesh(const ObjectSettings& a, const ObjectSettings& b) {
    const auto made_from = [](const ObjectSettings& of) {
        return std::tie(of.shipped, of.mesh, of.up, of.scale, of.unit, of.weld_tolerance, of.labels, of.areas,
                        of.parts_by, of.picture_mm.x, of.picture_mm.y);
    };
    return made_from(a) == made_from(b);
}

std::vector<std::string> overlap_remarks(const Mesh& mesh, const ObjectSettings& settings) {
    std::vector<std::string> remarks;
    for (const AreaOverlap& overlap : overlapping_areas(mesh))
        remarks.push_back(
            fmt::format("Areas \"{}\" and \"{}\" overlap: they share {:.4g} {}, {:.1f} % of the one and "
                        "{:.1f} % of the "
                        "other, which count for both.",
                        overlap.a, overlap.b, overlap.shared_area,
                        unit_of_lengths(settings) == "mm" ? "mm^2" : "squares of the file's unit",
                        100.0 * overlap.share_of_a, 100.0 * overlap.share_of_b));
    return remarks;
}

MadeMesh make_mesh(const ObjectSettings& settings, const std::filesystem::path& cache, bool with_appearance) {
    MadeMesh made;
    Mesh mesh;
    if (!settings.shipped.empty()) {
        mesh = shipped_sculpture(settings.shipped, cache);
    } else if (settings.is_flat()) {
        mesh = make_flat_mesh(settings.picture_mm, area_regions(settings));
        made.remarks = overlap_remarks(mesh, settings);
        order_for_drawing(mesh);
    } else {
        MeshCleaningReport report;
        SurfaceAppearance appearance;
        mesh =
            import_mesh(settings.mesh, import_of(settings), report, with_appearance ? &appearance : nullptr);
        made.remarks = describe(report);
        for (std::string& remark : overlap_remarks(mesh, settings))
            made.remarks.push_back(std::move(remark));
        made.origin = report.origin;
        std::vector<CornersFrom> from;
        order_for_drawing(mesh, appearance.says_something() ? &from : nullptr);
        if (appearance.says_something()) {
            appearance = rearranged(std::move(appearance), from);
            std::ranges::move(look_remarks(appearance, mesh), std::back_inserter(made.remarks));
            made.appearance_hash = hash_of_appearance(appearance);
            made.appearance = std::make_shared<const SurfaceAppearance>(std::move(appearance));
        }
    }
    made.hash = hash_of_mesh(mesh);
    made.mesh = std::move(mesh);
    return made;
}

/// The mesh's file and the pictures of its surface, by their names.
std::string files_of(const SurfaceAppearance& appearance, const std::filesystem::path& mesh) {
    std::string files = mesh.filename().string();
    for (const auto& picture : appearance.pictures)
        files += "; " + picture->file;
    return files;
}

/// `made`: its mesh, if it has one.
Object place_object(const ObjectSettings& settings, const Protocol& protocol, const MadeMesh* made) {
    Object object;
    object.id = settings.id;
    object.scenes.resize(protocol.views_at_all_sizes());
    if (!made) {
        if (!settings.lut.empty()) {
            Mesh names_alone;
            names_alone.part_names = map_part_names(settings);
            object.mesh = std::move(names_alone);
        }
        return object;
    }
    object.mesh = made->mesh;
    object.mesh_hash = made->hash;
    object.origin = made->origin;
    object.remarks = made->remarks;
    object.appearance = made->appearance;
    object.appearance_hash = made->appearance_hash;
    if (made->appearance)
        object.appearance_files = files_of(*made->appearance, settings.mesh);
    for (std::size_t i = 0; i < object.scenes.size(); ++i) {
        const ViewSettings& view = protocol.view_at(static_cast<int>(i));
        SceneView& scene = object.scenes[i];
        scene.view.image_px = {view.width_px, view.height_px};
        scene.bounds = object.mesh->bounds();
        scene.view.camera = settings.is_flat() ? camera_before_picture(settings, protocol)
                                               : camera_of(view, protocol, object.mesh, object.origin);
        // The target is seen in the plane of the screen: there a unit of length is as long as the eyes'
        // distance is measured in.
        Camera& camera = scene.view.camera;
        camera.aside = view.aside_mm * glm::distance(camera.position, camera.target) /
                       protocol.display.viewing_distance_mm;
        try {
            depth_range(scene.bounds, scene.view);
        } catch (const InputError& error) {
            throw InputError(fmt::format(
                "object \"{}\"{}: {}", settings.id,
                protocol.views.size() == 1 ? "" : fmt::format(", view \"{}\"", view.id), error.what()));
        }
    }
    return object;
}

bool has_mesh_of_its_own(const ObjectSettings& settings) {
    return !settings.shipped.empty() || !settings.mesh.empty() || settings.is_flat();
}

} // namespace

Object load_object(const ObjectSettings& settings, const Protocol& protocol,
                   const std::filesystem::path& cache) {
    if (!has_mesh_of_its_own(settings))
        return place_object(settings, protocol, nullptr);
    const MadeMesh made = make_mesh(settings, cache, asks_for_appearance(protocol));
    return place_object(settings, protocol, &made);
}

bool is_in_picture(const Object& object, int of_view, const ObjectPose& angle) {
    const SceneView& scene = object.scene(of_view);
    const View& view = scene.view;
    const TurntablePose pose = scene.pose_at(angle);
    const glm::dmat4 world_from_object = pose.world_from_object();
    const glm::dvec2 size(view.image_px);
    const bool has_vertex =
        std::any_of(object.mesh->positions.begin(), object.mesh->positions.end(), [&](const glm::vec3& p) {
            const glm::dvec3 world(world_from_object * glm::dvec4(p, 1.0));
            if (view.depth_of(world) <= 0.0)
                return false;
            const glm::dvec2 place = view.project(world);
            return glm::all(glm::greaterThanEqual(place, glm::dvec2(0.0))) &&
                   glm::all(glm::lessThan(place, size));
        });
    if (has_vertex)
        return true;
    // Seen from very near, one triangle may fill the picture with its corners outside.
    constexpr int rays_each_way = 32;
    const RayCaster caster(object.mesh);
    for (int i = 0; i < rays_each_way * rays_each_way; ++i) {
        const glm::dvec2 place = (glm::dvec2(i % rays_each_way, i / rays_each_way) + 0.5) * size /
                                 static_cast<double>(rays_each_way);
        if (caster.first_hit(to_object(view.ray_through(place), pose)))
            return true;
    }
    return false;
}

void add_points(Object& object, const Protocol& protocol, const PointListSettings& list, std::size_t index) {
    if (!is_on_object(protocol, list, index))
        return;
    if (!object.has_mesh())
        throw InputError(fmt::format("object \"{}\" has no mesh, and so no surface with places", object.id));
    for (ObjectPoint& point : points_on(protocol, list, object.mesh, object.scene()))
        object.points.push_back(std::move(point));
}

namespace {

/// Throws InputError if the file's colours hold the light of photographs and nobody said how they are meant.
void expect_lit(const Object& object, const MaterialSettings& material) {
    if (material.kind != MaterialKind::own)
        return;
    for (const FileMaterial& of_file : object.appearance->materials)
        if (of_file.is_unlit)
            throw InputError(fmt::format(
                "object \"{}\": its file says of \"{}\" that it is shown without light "
                "(KHR_materials_unlit): its "
                "colours are photographs, with the light of the room in them. If they are to be taken for "
                "what the surface reflects, write kind = \"diffuse\" and base = \"own\" for the material "
                "\"{}\"",
                object.id, of_file.name, material.id));
}

/// The names that MaterialSettings::of has must be those of the file.
void expect_known_names(const Object& object, const MaterialSettings& material) {
    const std::vector<FileMaterial>& materials = object.appearance->materials;
    for (const std::string& name : material.of) {
        if (std::ranges::find(materials, name, &FileMaterial::name) != materials.end())
            continue;
        std::vector<std::string_view> names;
        for (const FileMaterial& of_file : materials)
            names.push_back(of_file.name);
        throw InputError(fmt::format(
            "object \"{}\": its file has no material \"{}\", for which the material \"{}\" is to hold; it "
            "has {}",
            object.id, name, material.id,
            names.empty() ? "none with a name" : fmt::format("\"{}\"", fmt::join(names, "\", \""))));
    }
}

/// Throws InputError if a stimulus that is to be rendered needs a look that its object's file does not give.
void expect_appearances(const Protocol& protocol, std::span<const Object> objects) {
    if (!asks_for_appearance(protocol))
        return;
    for (const Stimulus& stimulus : all_stimuli(protocol)) {
        const auto index = static_cast<std::size_t>(stimulus.object);
        const Object& object = objects[index];
        const MaterialSettings& material = protocol.material_of(stimulus);
        if (!material.is_of_file() || !object.has_mesh() || find_frames(protocol, stimulus))
            continue;
        if (object.appearance) {
            expect_lit(object, material);
            expect_known_names(object, material);
            continue;
        }
        const std::filesystem::path& file = protocol.objects[index].mesh;
        throw InputError(fmt::format(
            "{}object \"{}\" is to be shown in the material \"{}\", which is of what the object's file says "
            "of its surface; {}: give a glTF, an OBJ with its .mtl or a PLY with colours, or a material of "
            "another kind",
            file.empty() ? "" : file.string() + ": ", object.id, material.id,
            file.empty() ? "it is made by overt and has none" : "it says nothing"));
    }
}

} // namespace

std::vector<Object> load_objects(const Protocol& protocol, const std::filesystem::path& cache) {
    std::vector<Object> objects;
    std::deque<MadeMesh> meshes;
    std::vector<const MadeMesh*> mesh_of; // each object's
    for (const ObjectSettings& settings : protocol.objects) {
        const MadeMesh* made = nullptr;
        for (std::size_t earlier = 0; earlier < objects.size() && !made; ++earlier)
            if (are_of_one_mesh(settings, protocol.objects[earlier]))
                made = mesh_of[earlier];
        if (!made && has_mesh_of_its_own(settings)) {
            MadeMesh own = make_mesh(settings, cache, asks_for_appearance(protocol));
            // Files of two names may hold one mesh.
            for (const MadeMesh& other : meshes)
                if (other.hash == own.hash)
                    own.mesh = other.mesh;
            made = &meshes.emplace_back(std::move(own));
        }
        mesh_of.push_back(made);
        objects.push_back(place_object(settings, protocol, made));
    }
    expect_appearances(protocol, objects);
    for (const PointListSettings& list : protocol.point_lists)
        for (std::size_t i = 0; i < objects.size(); ++i)
            add_points(objects[i], protocol, list, i);
    return objects;
}

} // namespace overt
