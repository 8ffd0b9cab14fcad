#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "app/cli/own_folders.h"
#include "app/stimuli/painted_areas.h"
#include "app/stimuli/picture_window.h"
#include "app/stimuli/stimulus_commands.h"
#include "app/stimuli/surface_view.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/scene/files/mesh_reader.h"
#include "render/gl/headless_context.h"
#include "render/window/window_inputs.h"
#include "render/window/window_keys.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

constexpr double brush_step = 1.15;
constexpr const char* painting_keys =
    "left button: paint    right button: turn    wheel: nearer    ↑ ↓: larger, smaller brush    1 … 9, tab: "
    "area    "
    "0: rub out    g, s: grow, shrink    m: mirror    backspace: take back    enter: save    Esc: end";

/// As far from its mirror image as a place may lie, as a share of the mesh's box.
constexpr double mirror_reach = 0.01;

/// What the hand does.
class Painter {
  public:
    Painter(PaintedAreas& areas, const SurfaceView& view, const Mesh& mesh, glm::ivec2 picture_px)
        : areas_(areas), view_(view), bounds_(mesh.bounds()), picture_px_(picture_px),
          radius_(0.03 * bounds_.diagonal()) {}

    enum class Wish : std::uint8_t { nothing, save, end };

    /// Keys and mouse in the order in which they came.
    Wish take(WindowContext& window) {
        WindowInput input;
        while (window.next_input(input)) {
            using Kind = ObserverInput::Kind;
            if (input.kind == Kind::key_down) {
                const Wish wish = take_key(window_key_of(input.glfw_key, 0));
                if (wish != Wish::nothing)
                    return wish;
            } else if (input.kind == Kind::text) {
                take_character(input.character);
            } else {
                take_mouse(input);
            }
        }
        return Wish::nothing;
    }

    const Orbit& orbit() const { return orbit_; }
    bool take_change() { return std::exchange(has_changed_, false); }

    std::string line() const {
        if (is_asked_)
            return "Not saved: Esc again to lose what was painted, enter to save it.";
        const std::string area =
            paint_ == 0 ? "rubbing out" : fmt::format("{}: {}", paint_, areas_.names[paint_ - 1u]);
        return fmt::format("{}    brush {:.3g}    {}", area, radius_, areas_.shares());
    }

  private:
    Wish take_key(WindowKey key) {
        has_changed_ = true;
        if (key == WindowKey::enter)
            return Wish::save;
        if (key == WindowKey::escape) {
            if (is_asked_ || !is_painted_)
                return Wish::end;
            is_asked_ = true;
            return Wish::nothing;
        }
        is_asked_ = false;
        if (key == WindowKey::up || key == WindowKey::down)
            radius_ *= key == WindowKey::up ? brush_step : 1.0 / brush_step;
        else if (key == WindowKey::tab)
            paint_ = static_cast<AreaPainting::Paint>(paint_ % areas_.names.size() + 1);
        else if (key == WindowKey::backspace)
            areas_.painting.undo();
        return Wish::nothing;
    }
    void take_character(char32_t character) {
        has_changed_ = true;
        if (character >= U'0' && character <= U'9' &&
            static_cast<std::size_t>(character - U'0') <= areas_.names.size())
            paint_ = static_cast<AreaPainting::Paint>(character - U'0');
        else if (paint_ > 0)
            take_letter(character);
    }
    void take_letter(char32_t letter) {
        if (letter != U'g' && letter != U's' && letter != U'm')
            return;
        areas_.painting.begin_step();
        is_painted_ = true;
        if (letter == U'g')
            areas_.painting.grow(paint_);
        else if (letter == U's')
            areas_.painting.shrink(paint_);
        else
            areas_.painting.mirror(paint_, bounds_.centre().x, mirror_reach * bounds_.diagonal());
    }

    void take_mouse(const WindowInput& input) {
        using Kind = ObserverInput::Kind;
        const glm::dvec2 at = input.from_middle_px + 0.5 * glm::dvec2(picture_px_);
        switch (input.kind) {
        case Kind::pointer_down:
            if (input.button == 1) {
                areas_.painting.begin_step();
                is_painting_ = true;
                stroke(at, at);
            } else {
                is_turning_ = true;
            }
            break;
        case Kind::pointer_up:
            (input.button == 1 ? is_painting_ : is_turning_) = false;
            return;
        case Kind::pointer_moved:
            if (is_painting_)
                stroke(last_, at);
            else if (is_turning_)
                orbit_.drag(at - last_);
            break;
        case Kind::wheel:
            orbit_.zoom(input.steps);
            has_changed_ = true;
            return;
        default:
            return;
        }
        has_changed_ |= is_painting_ || is_turning_;
        last_ = at;
    }
    /// Dabs along the pointer's way, so that a quick hand leaves no gaps.
    void stroke(glm::dvec2 from, glm::dvec2 to) {
        constexpr double px_between = 4.0;
        const int dabs = std::max(1, static_cast<int>(std::ceil(glm::distance(from, to) / px_between)));
        for (int i = 1; i <= dabs; ++i) {
            const auto hit = view_.surface_at(glm::mix(from, to, static_cast<double>(i) / dabs), orbit_);
            if (!hit)
                continue;
            areas_.painting.dab({hit->triangle, hit->barycentric}, radius_, paint_);
            is_painted_ = true;
        }
    }

    PaintedAreas& areas_;
    const SurfaceView& view_;
    Bounds bounds_;
    glm::ivec2 picture_px_;
    double radius_;
    AreaPainting::Paint paint_ = 1;
    Orbit orbit_;
    glm::dvec2 last_{0.0};
    bool is_painting_ = false, is_turning_ = false, is_painted_ = false, is_asked_ = false;
    bool has_changed_ = true;
};

SurfaceView::Tint tints_of(const PaintedAreas& areas) {
    return [&areas](std::uint32_t triangle) {
        const AreaPainting::Paint paint = areas.painting.paints()[triangle];
        return paint > 0 ? std::optional(colour_of_paint(paint)) : std::nullopt;
    };
}

/// False if the user ended without saving.
bool paint_in_window(OpenDisplay& opened, SurfaceView& view, const Mesh& mesh, PaintedAreas& areas) {
    opened.start();
    WindowContext& window = *opened.window();
    PictureWindow picture(opened);
    Painter painter(areas, view, mesh, window.framebuffer_px());
    while (!window.close_requested()) {
        window.poll_events();
        const Painter::Wish wish = painter.take(window);
        if (wish != Painter::Wish::nothing)
            return wish == Painter::Wish::save;
        if (!painter.take_change()) {
            std::this_thread::sleep_for(picture_rest);
            continue;
        }
        picture.show(view.draw(painter.orbit(), tints_of(areas)), painter.line());
    }
    return false;
}

/// Dabs in the coordinates of the file, each a step of its own.
void paint_given(const PaintAreasOptions& options, const Object& object, const ObjectSettings& settings,
                 PaintedAreas& areas) {
    const glm::dmat3 object_from_file =
        mm_of_unit(settings.unit) * z_up_from_file(up_axis_named(settings.up));
    const NearestSites sites(object.mesh);
    for (const auto& [name, x, y, z, radius] : options.dabs) {
        const AreaPainting::Paint paint = areas.paint_of(name);
        if (!(radius > 0.0))
            throw InputError(
                fmt::format("--dab {} {} {} {} {}: the radius must be above 0", name, x, y, z, radius));
        areas.painting.begin_step();
        areas.painting.dab(sites.nearest(object_from_file * glm::dvec3(x, y, z) - object.origin),
                           radius * mm_of_unit(settings.unit), paint);
    }
    const Bounds bounds = object.mesh->bounds();
    for (const std::string& name : options.mirrored) {
        areas.painting.begin_step();
        areas.painting.mirror(areas.paint_of(name), bounds.centre().x, mirror_reach * bounds.diagonal());
    }
}

} // namespace

int run_paint_areas(const PaintAreasOptions& given) {
    PaintAreasOptions options = given;
    if (options.out.empty())
        options.out = options.mesh.parent_path() / (options.mesh.stem().string() + "_areas.txt");
    if (options.out.extension() == ".annot" || options.out.extension() == ".label")
        throw InputError(
            fmt::format("{}: files of this name are FreeSurfer's; call it .txt", options.out.string()));
    std::error_code error;
    const bool goes_on =
        !options.labels.empty() && std::filesystem::equivalent(options.out, options.labels, error);
    if (std::filesystem::exists(options.out) && !options.overwrite && !goes_on)
        throw InputError(fmt::format("{0} is there already: go on with it by --labels {0}, or replace it by "
                                     "--overwrite",
                                     options.out.string()));
    const bool in_window = options.picture.empty() && options.dabs.empty() && options.mirrored.empty();
    if (in_window && !display_is_available())
        throw InputError(
            "there is no display to paint on: paint by --dab NAME X Y Z RADIUS, and look at it by "
            "--picture FILE");
    Protocol protocol = plain_protocol(options.mesh, options.up, options.unit);
    ObjectSettings& settings = protocol.objects.front();
    settings.labels = options.labels;
    fmt::print(stderr, "reading {} …\n", options.mesh.string());
    const Object object = load_object(settings, protocol, cache_folder());
    PaintedAreas areas(object.mesh, options.areas);
    paint_given(options, object, settings, areas);
    if (in_window) {
        OpenDisplay window({.context = ContextKind::window,
                            .size_px = picture_window_size(protocol.views.front()),
                            .title = "overt paint-areas",
                            .windowed = true});
        SurfaceView view(window.context(), protocol, object, window.window()->framebuffer_px());
        fmt::print(stderr, "{}\n", painting_keys);
        if (!paint_in_window(window, view, object.mesh, areas)) {
            fmt::print(stderr, "ended without saving\n");
            return 1;
        }
    } else if (!options.picture.empty()) {
        const auto context =
            make_headless_context(options.context == ContextKind::window ? std::nullopt : options.context);
        SurfaceView view(*context, protocol, object,
                         {protocol.views.front().width_px, protocol.views.front().height_px});
        Orbit orbit;
        orbit.turn_deg = options.turn_deg;
        write_srgb_png(options.picture, view.draw(orbit, tints_of(areas)));
        fmt::print(stderr, "{}\n", options.picture.string());
    }
    write_whole_file(options.out, labels_text(areas, object, settings));
    fmt::print("# {}\nlabels = \"{}\"\n", areas.shares(), options.out.string());
    return 0;
}

} // namespace overt
