#include <algorithm>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "app/cli/own_folders.h"
#include "app/stimuli/head_outline.h"
#include "app/stimuli/picture_window.h"
#include "app/stimuli/stimulus_commands.h"
#include "app/stimuli/surface_view.h"
#include "experiment/base/error.h"
#include "experiment/scene/files/mesh_reader.h"
#include "render/gl/headless_context.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

constexpr double radius_step = 1.05;
constexpr const char* picking_keys = "drag: turn    wheel: nearer    ↑ ↓: larger, smaller    "
                                     "backspace: take back    enter: done    Esc: end";

PartRegion given_head(const PickHeadOptions& options) {
    PartRegion head{"head", {}, {}};
    for (const auto& [x, y, z, radius] : options.spheres) {
        if (!(radius > 0.0))
            throw InputError(
                fmt::format("--sphere {} {} {} {}: the radius must be above 0", x, y, z, radius));
        head.spheres.emplace_back(x, y, z, radius);
    }
    for (const auto& [x, y, z, to_x, to_y, to_z] : options.planes) {
        if (to_x == 0.0 && to_y == 0.0 && to_z == 0.0)
            throw InputError(fmt::format(
                "--plane {} {} {} 0 0 0: the last three numbers are a direction, and cannot all be 0", x, y,
                z));
        head.half_spaces.push_back({{x, y, z}, {to_x, to_y, to_z}});
    }
    return head;
}

/// The mesh, its head so far, and pictures of both.
class HeadView {
  public:
    HeadView(const GlContext& context, const Protocol& protocol, const Object& object, glm::ivec2 image_px)
        : object_(&object), surface_(context, protocol, object, image_px) {}

    /// Share of the surface's area that belongs to it, by triangles, as a protocol has it.
    double take(const std::optional<PartRegion>& head) {
        const Mesh& mesh = object_->mesh;
        is_head_.assign(mesh.triangles.size(), false);
        double area = 0.0;
        for (std::size_t i = 0; head && i < is_head_.size(); ++i) {
            const glm::uvec3& t = mesh.triangles[i];
            const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
            if (head->contains((a + b + c) / 3.0)) {
                is_head_[i] = true;
                area += 0.5 * glm::length(glm::cross(b - a, c - a));
            }
        }
        return area / mesh.area();
    }

    /// The surface under a point of the picture.
    std::optional<glm::dvec3> surface_at(glm::dvec2 image_px, const Orbit& orbit) const {
        const std::optional<RayHit> hit = surface_.surface_at(image_px, orbit);
        return hit ? std::optional(hit->position) : std::nullopt;
    }

    LinearImage draw(const Orbit& orbit, std::span<const glm::dvec3> points) {
        const auto tint = [&](std::uint32_t triangle) {
            return is_head_[triangle] ? std::optional(glm::vec3(1.0f, 0.45f, 0.15f)) : std::nullopt;
        };
        return surface_.draw(orbit, tint, points);
    }

  private:
    const Object* object_;
    SurfaceView surface_;
    std::vector<bool> is_head_;
};

/// What to do next.
std::string request_text(std::size_t points) {
    constexpr const char* requests[] = {
        "Click on one side of the head.", "Turn the head, and click on its opposite side.",
        "Click on the neck, where the head is to end.", "Click again for another neck, or press enter."};
    return requests[std::min<std::size_t>(points, 3)];
}

/// False if the user ended without a head.
bool pick_in_window(OpenDisplay& opened, HeadView& view, HeadOutline& outline) {
    opened.start();
    WindowContext& window = *opened.window();
    PictureWindow picture(opened);
    Orbit orbit;
    bool has_changed = true;
    while (!window.close_requested()) {
        window.poll_events();
        WindowKeyPress press{};
        while (window.next_key_press(press)) {
            has_changed = true;
            if (press.key == WindowKey::escape)
                return false;
            if (press.key == WindowKey::enter && outline.region())
                return true;
            if (press.key == WindowKey::backspace)
                outline.take_back();
            else if (press.key == WindowKey::up)
                outline.scale(radius_step);
            else if (press.key == WindowKey::down)
                outline.scale(1.0 / radius_step);
        }
        const WindowContext::Dragging dragging = window.take_dragging();
        if (dragging.by_px != glm::dvec2(0.0) || dragging.wheel_steps != 0.0) {
            orbit.drag(dragging.by_px);
            orbit.zoom(dragging.wheel_steps);
            has_changed = true;
        }
        for (std::size_t i = 0; i < dragging.click_count; ++i) {
            if (const auto point = view.surface_at(dragging.clicks_px[i], orbit)) {
                outline.pick(*point);
                has_changed = true;
            }
        }
        if (!std::exchange(has_changed, false)) {
            std::this_thread::sleep_for(picture_rest);
            continue;
        }
        const double share = view.take(outline.region());
        picture.show(view.draw(orbit, outline.points()),
                     fmt::format("{}    head: {:.1f} % of the surface", request_text(outline.points().size()),
                                 100.0 * share));
    }
    return false;
}

} // namespace

int run_pick_head(const PickHeadOptions& options) {
    const bool in_window = options.picture.empty();
    if (in_window && !display_is_available())
        throw InputError("there is no display to pick a head on: look at one that is given with --sphere and "
                         "--plane by --picture FILE");
    const Protocol protocol = plain_protocol(options.mesh, options.up, options.unit);
    const ObjectSettings& settings = protocol.objects.front();
    const PartRegion given = given_head(options);
    fmt::print(stderr, "reading {} …\n", options.mesh.string());
    const Object object = load_object(settings, protocol, cache_folder());
    const glm::dmat3 object_from_file = z_up_from_file(up_axis_named(settings.up));
    const double scale = mm_of_unit(settings.unit);
    const bool is_given = !given.spheres.empty() || !given.half_spaces.empty();
    const double height = object.scene().bounds.max.z - object.scene().bounds.min.z;
    HeadOutline outline(0.1 * height,
                        is_given ? std::optional(transformed(given, object_from_file, scale, -object.origin))
                                 : std::nullopt);
    double share = 0.0;
    if (in_window) {
        OpenDisplay window({.context = ContextKind::window,
                            .size_px = picture_window_size(protocol.views.front()),
                            .title = "overt pick-head",
                            .windowed = true});
        HeadView view(window.context(), protocol, object, window.window()->framebuffer_px());
        fmt::print(stderr, "{}\n", picking_keys);
        if (!pick_in_window(window, view, outline)) {
            fmt::print(stderr, "ended without a head\n");
            return 1;
        }
        share = view.take(outline.region());
    } else {
        const auto context =
            make_headless_context(options.context == ContextKind::window ? std::nullopt : options.context);
        HeadView view(*context, protocol, object,
                      {protocol.views.front().width_px, protocol.views.front().height_px});
        share = view.take(outline.region());
        Orbit orbit;
        orbit.turn_deg = options.turn_deg;
        write_srgb_png(options.picture, view.draw(orbit, {}));
        fmt::print(stderr, "{}\n", options.picture.string());
    }
    if (!outline.region())
        return 0;
    if (share <= 0.0)
        throw InputError(
            fmt::format("{}: no triangle lies in this head; its coordinates must be those of the "
                        "mesh file",
                        options.mesh.string()));
    fmt::print("# {:.1f} % of the surface\n{}\n", 100.0 * share,
               head_key(transformed(transformed(*outline.region(), glm::dmat3(1.0), 1.0, object.origin),
                                    glm::transpose(object_from_file), 1.0 / scale)));
    return 0;
}

} // namespace overt
