#include "app/replay/replay_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/interruption.h"
#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/record/chosen_presentation.h"
#include "app/record/picture_marks.h"
#include "app/record/recorded_surface.h"
#include "app/replay/movie_file.h"
#include "app/replay/recorded_experiment.h"
#include "app/replay/stimuli_again.h"
#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/record/read/shown_levels.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

constexpr double dot_radius_px = 1.5, ring_radius_px = 8.0, ring_line_px = 1.5;
const glm::vec3 dot_colour{1.0f, 0.05f, 0.02f}, ring_colour{0.1f, 0.9f, 1.0f};

/// Blends a colour in by how much of each pixel a shape covers, as its distance from the shape's edge says.
template <class Distance>
void paint(LinearImage& image, glm::dvec2 middle, double reach, const glm::vec3& colour,
           const Distance& distance) {
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(middle - reach)), glm::ivec2(0));
    const glm::ivec2 last = glm::min(glm::ivec2(glm::ceil(middle + reach)), image.size_px - 1);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const double from_middle = glm::distance(glm::dvec2(x + 0.5, y + 0.5), middle);
            const auto share = static_cast<float>(std::clamp(0.5 - distance(from_middle), 0.0, 1.0));
            glm::vec4& pixel = image.at(x, y);
            pixel = glm::vec4(glm::mix(glm::vec3(pixel), colour, share), 1.0f);
        }
}

/// What there is to draw a trial with, and its frames.
class TrialPictures {
  public:
    TrialPictures(const SessionRecord& record, const ReplayOptions& options)
        : record_(record),
          trial_(chosen_presentation(record, attempt_at(record, *options.trial), options.slot)),
          surfaces_(record), frames_(record, trial_, lookup_of(record, trial_, surfaces_)),
          levels_(record, trial_), marks_(record, trial_, lookup_of(record, trial_, surfaces_)),
          experiment_(recorded_experiment(record, options.files, cache_folder())),
          stimuli_(experiment_, cache_folder(),
                   options.context ? options.context : context_of(record.header())) {
        const std::string why_not = stimuli_.prepare(record, experiment_.protocol);
        if (!why_not.empty())
            throw InputError(why_not);
        const Stimulus stimulus = record.header().in_slot(trial_.trial.shown(0));
        for (const RecordedStimulus& recorded : record.header().stimuli)
            if (recorded.stimulus == stimulus &&
                !recorded.is_same_as({stimulus,
                                      {},
                                      stimuli_.library().frames_hash(stimulus),
                                      stimuli_.library().made_from_hash(stimulus)}))
                fmt::print(stderr,
                           "the frames that are there ({}) are not those that were shown ({}): the picture "
                           "has other light\n",
                           stimuli_.library().source_of(stimulus), recorded.source);
    }

    const ShownFrames& frames() const { return frames_; }
    const TrialRecord& trial() const { return trial_; }
    glm::ivec2 image_px() const { return record_.header().screen_of_slot(trial_.trial.slot).image_px; }

    LinearImage draw(const ShownFrame& shown) const {
        LinearImage frame(image_px());
        if (shown.lit) {
            const Stimulus stimulus =
                record_.header().in_slot({levels_.at(shown.lit->refresh), trial_.trial.slot});
            const std::vector<int> pages = stimuli_.library().page_of_frame(stimulus);
            frame =
                stimuli_.library().page(stimulus, pages[static_cast<std::size_t>(shown.lit->frame.value)]);
            marks_.draw_lit(frame, *shown.lit);
        }
        return with_gaze(frame, shown, record_.header().display.background);
    }

  private:
    static const SurfaceLookup* lookup_of(const SessionRecord& record, const TrialRecord& trial,
                                          RecordedSurfaces& surfaces) {
        if (record.header().stimuli.empty())
            throw InputError(fmt::format("{}: this session was imported: the program has no frames of it",
                                         record.directory().string()));
        return surfaces.lookup_of(viewed_in(record.header(), trial.trial));
    }

    const SessionRecord& record_;
    const TrialRecord trial_;
    RecordedSurfaces surfaces_;
    ShownFrames frames_;
    ShownLevels levels_;
    PictureMarks marks_;
    Experiment experiment_;
    mutable StimuliAgain stimuli_;
};

void require_room_for(const fs::path& file, bool overwrite) {
    if (!overwrite && fs::exists(file))
        throw InputError(
            fmt::format("{}: this file is there already: name another, or give --overwrite", file.string()));
}

std::string part_of(const SessionHeader& header, const TrialRecord& trial, const SurfacePoint& point) {
    const auto& names = header.objects[static_cast<std::size_t>(trial.trial.stimulus.object)].part_names;
    return point.part < names.size() ? names[point.part] : "";
}

nlohmann::ordered_json json_of(const SessionRecord& record, const TrialRecord& trial,
                               const ShownFrame& shown) {
    const auto& object = record.header().objects[static_cast<std::size_t>(trial.trial.stimulus.object)];
    nlohmann::ordered_json json{{"trial", trial.trial.index + 1},
                                {"attempt", trial.attempt},
                                {"frame", shown.number},
                                {"begin_s", shown.begin_s},
                                {"end_s", shown.end_s},
                                {"samples", shown.samples},
                                {"samples_with_gaze", shown.gaze_px.size()}};
    if (shown.planned)
        json["planned_animation_frame"] = shown.planned->value;
    if (shown.lit)
        json["shown_animation_frame"] = shown.lit->frame.value;
    if (shown.mean_px)
        json["gaze_image_px"] = {shown.mean_px->x, shown.mean_px->y};
    if (shown.surface)
        json["surface_point"] = {{"x", shown.surface->position.x},
                                 {"y", shown.surface->position.y},
                                 {"z", shown.surface->position.z},
                                 {"unit", object.unit},
                                 {"part", part_of(record.header(), trial, *shown.surface)}};
    return json;
}

std::string sentence_on(const SessionRecord& record, const TrialRecord& trial, const ShownFrame& shown,
                        int count) {
    std::string text = fmt::format("trial {}, frame {} of {} ({:.4f} to {:.4f} s): ", trial.trial.index + 1,
                                   shown.number, count, shown.begin_s, shown.end_s);
    text += shown.lit ? fmt::format("animation frame {} was lit", shown.lit->frame.value) : "nothing was lit";
    if (shown.lit && shown.planned && shown.planned->value != shown.lit->frame.value)
        text += fmt::format(" where {} was planned", shown.planned->value);
    text += fmt::format("; {} of {} samples with gaze", shown.gaze_px.size(), shown.samples);
    if (!shown.mean_px)
        return text;
    text += fmt::format(", at {:.1f}, {:.1f} px of the image on average", shown.mean_px->x, shown.mean_px->y);
    if (!shown.surface)
        return text + ", beside the object";
    const glm::dvec3& at = shown.surface->position;
    const std::string part = part_of(record.header(), trial, *shown.surface);
    const auto& object = record.header().objects[static_cast<std::size_t>(trial.trial.stimulus.object)];
    return text + fmt::format(": surface point {:.2f}, {:.2f}, {:.2f} {}{}", at.x, at.y, at.z,
                              object.unit == "mm" ? "mm" : "in the unit of the mesh",
                              part.empty() ? "" : ", on the " + part);
}

int draw_picture(const SessionRecord& record, const ReplayOptions& options) {
    require_room_for(options.picture, options.overwrite);
    const TrialPictures pictures(record, options);
    const int count = pictures.frames().count();
    if (*options.frame > count)
        throw InputError(
            fmt::format("--frame {}: trial {} showed {} frames", *options.frame, *options.trial, count));
    const ShownFrame shown = pictures.frames().frame(*options.frame);
    write_srgb_png(options.picture, pictures.draw(shown));
    if (options.json) {
        nlohmann::ordered_json json = json_of(record, pictures.trial(), shown);
        json["picture"] = options.picture.string();
        fmt::print("{}", json_text(json));
    } else {
        fmt::print("{}\npicture: {}\n", sentence_on(record, pictures.trial(), shown, count),
                   options.picture.string());
    }
    return 0;
}

int draw_movie(const SessionRecord& record, const ReplayOptions& options) {
    MovieFile::require_ffmpeg(); // before stimuli are made for minutes
    require_room_for(options.movie, options.overwrite);
    const TrialPictures pictures(record, options);
    const ShownFrames& frames = pictures.frames();
    MovieFile movie(options.movie, pictures.image_px(), frames.rate_hz(), options.overwrite);
    ProgressBar bar;
    auto told = nlohmann::ordered_json::array();
    for (int number = 1; number <= frames.count(); ++number) {
        Interruption::check("The movie");
        const ShownFrame shown = frames.frame(number);
        movie.add(pictures.draw(shown));
        if (options.json)
            told.push_back(json_of(record, pictures.trial(), shown));
        bar.update("frames of the movie", number, frames.count());
    }
    bar.finish();
    movie.finish();
    if (options.json)
        fmt::print("{}",
                   json_text(nlohmann::ordered_json{
                       {"movie", options.movie.string()}, {"rate_hz", frames.rate_hz()}, {"frames", told}}));
    else
        fmt::print("trial {}: {} frames at {:.3f} Hz\nmovie: {}\n", *options.trial, frames.count(),
                   frames.rate_hz(), options.movie.string());
    return 0;
}

} // namespace

LinearImage with_gaze(const LinearImage& frame, const ShownFrame& shown, double background) {
    LinearImage image = frame;
    for (glm::vec4& pixel : image.pixels)
        pixel = glm::vec4(glm::vec3(pixel) + (1.0f - pixel.a) * static_cast<float>(background), 1.0f);
    for (const glm::dvec2& gaze : shown.gaze_px)
        paint(image, gaze, dot_radius_px + 1.0, dot_colour,
              [](double from_middle) { return from_middle - dot_radius_px; });
    if (shown.mean_px)
        paint(image, *shown.mean_px, ring_radius_px + ring_line_px + 1.0, ring_colour,
              [](double from_middle) { return std::abs(from_middle - ring_radius_px) - 0.5 * ring_line_px; });
    return image;
}

int draw_trial(const SessionRecord& record, const ReplayOptions& options) {
    const Interruption interruption;
    return options.movie.empty() ? draw_picture(record, options) : draw_movie(record, options);
}

} // namespace overt
