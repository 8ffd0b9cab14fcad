#include "experiment/record/read/pointed_answer.h"

#include "experiment/base/text_number.h"
#include "experiment/maps/coordinate_maps.h"

namespace overt {

std::optional<glm::dvec2> read_pointed_px(std::string_view value) {
    const std::size_t space = value.find(' ');
    if (space == std::string_view::npos)
        return std::nullopt;
    const auto right = number_in<double>(value.substr(0, space)),
               down = number_in<double>(value.substr(space + 1));
    return right && down ? std::optional(glm::dvec2(*right, *down)) : std::nullopt;
}

std::optional<PointedAnswer> pointed_answer(const SessionHeader& header, const TrialRecord& seen,
                                            const FlipHistory& history, const SurfaceLookup* lookup,
                                            const PointedPlace& place) {
    const ScreenGeometry screen = header.screen_of_slot(seen.trial.slot);
    PointedAnswer pointed;
    pointed.image_px = screen.image_from_screen(place.at);
    if (!screen.is_inside_image(pointed.image_px))
        return std::nullopt;
    const auto slot = static_cast<std::size_t>(seen.trial.slot);
    if (slot < header.slots.size())
        pointed.slot = header.slots[slot].id;
    pointed.shown = history.lighting_at(place.when, place.at.y_px).shown;
    if (!pointed.shown || !lookup)
        return pointed;
    pointed.surface = lookup->surface_at(pointed.shown->pose, pointed.image_px);
    if (!pointed.surface)
        return pointed;
    const RecordedObject& object = header.objects[static_cast<std::size_t>(seen.trial.stimulus.object)];
    if (pointed.surface->part < object.part_names.size())
        pointed.part = object.part_names[pointed.surface->part];
    const auto* const maps = dynamic_cast<const CoordinateMaps*>(lookup);
    if (maps && place.covariance_px)
        pointed.footprint =
            footprint_of(maps->sight_lines(pointed.shown->pose), pointed.image_px,
                         corners_of(maps->mesh(), pointed.surface->triangle), *place.covariance_px);
    return pointed;
}

std::optional<PointedAnswer> pointed_answer(const SessionHeader& header, const TrialRecord& seen,
                                            const FlipHistory& history, const SurfaceLookup* lookup,
                                            const GivenAnswer& given) {
    if (given.kind != point_kind || given.is_missed || !given.answered_at)
        return std::nullopt;
    const std::optional<glm::dvec2> from_middle = read_pointed_px(given.value);
    if (!from_middle)
        return std::nullopt;
    const ScreenPoint middle = header.display.screen.centre();
    return pointed_answer(header, seen, history, lookup,
                          {.at = {middle.x_px + from_middle->x, middle.y_px + from_middle->y},
                           .when = *given.answered_at,
                           .covariance_px = covariance_of_pixel()});
}

} // namespace overt
