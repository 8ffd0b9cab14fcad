#include <fmt/format.h>

#include "experiment/ports/tracker_kinds.h"
#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

namespace {

constexpr std::string_view eyes[] = {"left", "right", "both"};

/// "Which eye tracker. `one`: …. `other`: …."
std::string_view tracker_explanation() {
    static const std::string text = [] {
        std::string words = "Which eye tracker.";
        for (const TrackerKindRow& kind : tracker_kinds)
            words += fmt::format(" `{}`: {}.", kind.name, kind.explanation);
        return words;
    }();
    return text;
}

/// What each tracker of a session has, as members of `T`: TrackerSettings, or what is made from it.
template <class T> std::vector<Key> tracker_keys() {
    const auto at = []<class Value>(Value TrackerSettings::*member) -> Value T::* { return member; };
    return {
        {{.name = "kind", .choices = tracker_names, .explanation = tracker_explanation()},
         at(&TrackerSettings::kind)},
        {{.name = "rate_hz",
          .unit = "Hz",
          .low = 10,
          .high = 10000,
          .explanation = "Gaze samples per second."},
         at(&TrackerSettings::rate_hz)},
        {{.name = "address",
          .if_left_out = "what is usual for the kind",
          .explanation =
              "Where the tracker is. `eyelink`: address of its host, or `dummy` to try the "
              "library without one. `opengaze` and `pupil`: host or host:port. `lsl`: name of "
              "the stream. `tobii`: its address (tet-tcp://…) or "
              "serial number. `hid`: /dev/hidrawN, or vendor:product. `replay`: a session's folder, "
              "or an EyeLink recording (.asc)."},
         at(&TrackerSettings::address)},
        {{.name = "library",
          .if_left_out = "where the system looks",
          .explanation = "The library of the tracker's maker, a file, for kinds that need one."},
         at(&TrackerSettings::library)},
        {{.name = "outlet",
          .explanation = "Whether samples are also sent on as a stream \"overt gaze\" of the Lab "
                         "Streaming Layer, of trackers that measure in real time."},
         at(&TrackerSettings::outlet)},
        {{.name = "point",
          .explanation = "Of `opengaze`, which point of gaze is taken. `eyes`: each eye's own. "
                         "`best`: the mean of both, or that of the one that is found."},
         at(&TrackerSettings::point)},
        {{.name = "surface", .explanation = "Of `pupil`, the surface in Pupil Capture that is the screen."},
         at(&TrackerSettings::surface)},
        {{.name = "least_confidence",
          .low = 0,
          .high = 1,
          .explanation = "Of `pupil`, and of streams that tell confidence: gaze of less is lost."},
         at(&TrackerSettings::least_confidence)},
        {{.name = "channels",
          .if_left_out = "what the stream tells",
          .explanation =
              "Of `lsl`, what the stream's channels mean: eye (or none), meaning, and the channel's "
              "label or its number from 1, such as `[\"left x 1\", \"left y 2\", \"right pupil "
              "PupilRight\"]`. Meanings are x, y, confidence, pupil, eye-x, eye-y, eye-z."},
         at(&TrackerSettings::channels)},
        {{.name = "unit", .explanation = "Of `lsl`, the unit of gaze: pixels, or shares of the screen."},
         at(&TrackerSettings::unit)},
        {{.name = "y_is_up",
          .explanation = "Of `lsl`, whether y grows upward from the lower edge of the screen."},
         at(&TrackerSettings::y_is_up)},
        {{.name = "eye",
          .choices = eyes,
          .explanation = "The eye that is tracked. Of both, the right one is analysed."},
         at(&TrackerSettings::eye)},
        {{.name = "simulated_noise_deg",
          .unit = "deg",
          .low = 0,
          .high = 10,
          .explanation = "Standard deviation of each simulated sample."},
         at(&TrackerSettings::simulated_noise_deg)},
        {{.name = "simulated_accuracy_deg",
          .unit = "deg",
          .low = 0,
          .high = 10,
          .explanation = "Standard deviation of the constant error of a simulated trial."},
         at(&TrackerSettings::simulated_accuracy_deg)},
        {{.name = "simulated_clock_drift_ppm",
          .unit = "ppm",
          .low = -10000,
          .high = 10000,
          .explanation = "How much faster the simulated tracker's clock runs than the session's."},
         at(&TrackerSettings::simulated_clock_drift_ppm)},
    };
}

} // namespace

Section display() {
    using D = DisplaySettings;
    return {
        .name = "display",
        .explanation = "The screen in front of the observer. The defaults are those of a Cambridge Research "
                       "Systems Display++ at 1.75 m.",
        .keys =
            {
                {{.name = "width_px",
                  .unit = "px",
                  .low = 16,
                  .high = 16384,
                  .explanation = "Pixels in a row of the screen."},
                 &D::width_px},
                {{.name = "height_px",
                  .unit = "px",
                  .low = 16,
                  .high = 16384,
                  .explanation = "Rows of the screen."},
                 &D::height_px},
                {{.name = "refresh_hz",
                  .unit = "Hz",
                  .low = 1,
                  .high = 1000,
                  .explanation =
                      "Refresh rate; to within 0.2 % a whole multiple of `animation.frame_rate_hz`, so that "
                      "every frame is lit equally long: at 59.94 Hz a frame of 30 Hz is held for "
                      "two refreshes, which is 29.97 frames a second, and 8 s last 8.008 s."},
                 &D::refresh_hz},
                {{.name = "width_mm",
                  .unit = "mm",
                  .low = 10,
                  .high = 20000,
                  .explanation = "Width of the lit area, by which visual angles are reckoned."},
                 &D::width_mm},
                {{.name = "height_mm",
                  .unit = "mm",
                  .low = 10,
                  .high = 20000,
                  .explanation = "Height of the lit area."},
                 &D::height_mm},
                {{.name = "viewing_distance_mm",
                  .unit = "mm",
                  .low = 50,
                  .high = 50000,
                  .explanation = "From the observer's eye to the middle of the screen."},
                 &D::viewing_distance_mm},
                {{.name = "output",
                  .choices = names_in<output_modes>,
                  .explanation =
                      "How light is packed into the video signal: 8 or 10 bits per channel for any "
                      "display, the 16-bit modes of a Display++, or those of VPixx devices. "
                      "`color++` and `vpixx-c48` join pixels in pairs; see "
                      "[output.md](output.md)."},
                 &D::output},
                {{.name = "dither",
                  .explanation = "How the native modes spread what lies between two of their levels over "
                                 "neighbouring pixels and refreshes."},
                 &D::dither},
                {{.name = "pair_filter",
                  .explanation = "How pixels become the one colour of a pair, in linear light: the mean of "
                                 "the two, or a Lanczos filter over twelve."},
                 &D::pair_filter},
                {{.name = "monitor",
                  .explanation =
                      "Which of several monitors the observer sees: the name of its output, such as `DP-1`, "
                      "or "
                      "the one in its EDID, such as `Display++`, or its number; `overt doctor` lists all "
                      "three. "
                      "Without it, the only one of this size, or of this size and rate. A session is refused "
                      "where that leaves none or several. `--monitor` goes before it."},
                 &D::monitor},
                {{.name = "box",
                  .explanation =
                      "The Display++ or Bits# that shows `mono++`, `color++` and `bits++`: `auto` looks for "
                      "it on the USB serial ports, a path such as `/dev/ttyACM0` names its port, and with "
                      "`none` its mode is not switched and it is not asked anything. Sessions on a real "
                      "screen in "
                      "real time need it; see [display_plus_plus.md](display_plus_plus.md)."},
                 &D::box},
                {{.name = "onset_trigger",
                  .low = 0,
                  .high = 16777215,
                  .explanation =
                      "Digital outputs that the first refresh of a presentation raises, as a sum of "
                      "1, 2, 4 …; 0 for none. A Display++ has ten (up to 1023) and raises them for "
                      "5 ms; a VPixx device in its Pixel Mode has 24 and raises them for the "
                      "refresh; see [output.md](output.md)."},
                 &D::onset_trigger},
                {{.name = "timing",
                  .explanation =
                      "With `proven`, a session in a window in real time is refused where no real vertical "
                      "blank tells when its pictures are lit. With `unproven` it runs, and its record, its "
                      "exports and reports say that times and missed refreshes are unproven. Of no effect in "
                      "virtual time and without a window; see [vblank_sources.md](vblank_sources.md)."},
                 &D::timing},
                {{.name = "photodiode",
                  .explanation =
                      "A square in this corner that changes between white and black with each frame "
                      "of the animation, white first, for a photodiode; black otherwise. It stands "
                      "below the rows that carry messages."},
                 &D::photodiode},
                {{.name = "photodiode_px",
                  .unit = "px",
                  .low = 2,
                  .high = 1000,
                  .explanation = "Side of that square."},
                 &D::photodiode_px},
                {{.name = "tags_px",
                  .unit = "px",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Side of the AprilTags (tag36h11, 0 to 5) that stand in the corners of the "
                                 "screen, and in the middle of its left and right edge where there is room, "
                                 "for eye trackers with a scene camera; a multiple of 10, or of 20 where the "
                                 "output joins pixels in pairs. 0 for none. See [trackers.md](trackers.md)."},
                 &D::tags_px},
                {{.name = "tags_light",
                  .low = 0.02,
                  .high = 1,
                  .explanation = "Light of their white modules, as a share of the display's white; the black "
                                 "ones have none."},
                 &D::tags_light},
                {{.name = "gamma",
                  .low = 0.1,
                  .high = 5,
                  .explanation = "Exponent from signal to light: 1 for a display that linearises itself, "
                                 "about 2.2 for an ordinary monitor."},
                 &D::gamma},
                {{.name = "linearised_by",
                  .explanation =
                      "What makes light proportional to the signal. `display`: the panel itself. `box`: the "
                      "display box, by `box_gamma_table`. `none`: nothing, and overt corrects for `gamma`. "
                      "Sessions on a real screen in real time need one of these, or a `characterisation`; "
                      "the first two leave `gamma` at 1."},
                 &D::linearised_by},
                {{.name = "box_gamma_table",
                  .explanation = "The table that the display box is told to use, a file on its disk. "
                                 "`13bitLinearLUT.txt` leaves values as they are."},
                 &D::box_gamma_table},
                {{.name = "video_check_days",
                  .unit = "days",
                  .low = 0,
                  .high = 3650,
                  .explanation =
                      "So old may the last `overt display verify --hardware` be before a session that goes "
                      "through a display box: it proves, for one box, graphics card, driver, output and "
                      "mode, that the bytes arrive as they are drawn. 0: none is asked for, and the record "
                      "says so."},
                 &D::video_check_days},
                {{.name = "characterisation",
                  .if_left_out = "none",
                  .explanation = "File with what was measured of the display, instead of `gamma`: primaries, "
                                 "black, and the curve of each channel; see "
                                 "[characterisation.md](characterisation.md)."},
                 &D::characterisation_file},
                {{.name = "latency_ms",
                  .unit = "ms",
                  .low = 0,
                  .high = 1000,
                  .explanation = "From the vertical blank to the light of the first row."},
                 &D::latency_ms},
                {{.name = "background",
                  .low = 0,
                  .high = 1,
                  .explanation = "Linear grey around the stimulus, 1 being the display's white."},
                 &D::background},
                {{.name = "frame_store_mb",
                  .unit = "MB",
                  .low = 1,
                  .high = 1000000,
                  .explanation =
                      "What the frames of the shown stimulus and of the next may take on the graphics "
                      "card. If both do not fit, the next is loaded before its trial instead of "
                      "during the answer before."},
                 &D::frame_store_mb},
                {{.name = "background_cd_m2",
                  .unit = "cd/m2",
                  .low = 0,
                  .high = 1e5,
                  .if_left_out = "by `background`",
                  .explanation = "The same as a luminance; needs a `characterisation`."},
                 &D::background_cd_m2},
            },
        .home = &Protocol::display};
}

Section tracker() {
    using T = TrackerSettings;
    std::vector<Key> keys = tracker_keys<T>();
    const std::vector<Key> drift{
        {{.name = "drift_limit_deg",
          .unit = "deg",
          .low = 0.01,
          .high = 45,
          .explanation =
              "A drift check that finds a larger error, or no eye, has failed. The record says so."},
         &T::drift_limit_deg},
        {{.name = "on_drift",
          .explanation = "What becomes of a trial whose drift check failed. `note`: it is presented "
                         "all the same. "
                         "`retry`: the target is shown again. `recalibrate`: the tracker is "
                         "calibrated, and the trial "
                         "begun anew. `reject`: it is not presented, and comes again as `[repeat] "
                         "rejected` says."},
         &T::on_drift},
        {{.name = "drift_checks",
          .low = 1,
          .high = 20,
          .explanation =
              "Of a trial, with `retry` and `recalibrate`. If the last fails, too, it is presented "
              "all the same."},
         &T::drift_checks},
    };
    keys.insert(keys.end(), drift.begin(), drift.end());
    return {.name = "tracker",
            .explanation = "The eye tracker, and how a simulated one differs from a perfect one.",
            .keys = std::move(keys),
            .home = &Protocol::tracker};
}

Section further_tracker() {
    using F = FurtherTrackerSettings;
    std::vector<Key> keys = tracker_keys<F>();
    keys.insert(keys.begin(), {{.name = "id",
                                .is_required = true,
                                .is_identifier = true,
                                .explanation = "By which its record is named: `trackers/ID` in the session's "
                                               "folder."},
                               &F::id});
    return {
        .name = "further_tracker",
        .explanation =
            "Eye trackers that record at the same time as that of `[tracker]`, such as two that are to be "
            "compared. Each is calibrated as `[calibration]` says, after the session's own, and has a "
            "record of its own, which every command reads as a session; see [trackers.md](trackers.md). "
            "Drift checks, and whether a trial counts, are a matter of `[tracker]` alone. The keys are "
            "those of `[tracker]`.",
        .keys = std::move(keys),
        .home = &Protocol::further_trackers};
}

Section calibration() {
    using C = CalibrationKeys;
    // What the calibration itself needs are members of its base.
    const auto number = [](double CalibrationSettings::*member) -> double C::* { return member; };
    const auto count = [](int CalibrationSettings::*member) -> int C::* { return member; };
    return {
        .name = "calibration",
        .explanation = "How the eye tracker is calibrated and what of its validation is accepted; see "
                       "[trackers.md](trackers.md).",
        .keys =
            {
                {{.name = "by",
                  .explanation =
                      "Who calibrates. `auto`: the tracker where it can, else the program. `tracker`: "
                      "the tracker. `overt`: the program, on top of what the tracker measures."},
                 &C::by},
                {{.name = "points", .explanation = "Targets of a calibration by the program: 3, 5, 9 or 13."},
                 count(&C::points)},
                {{.name = "validation_points",
                  .explanation = "Targets of its validation, at other places: 3, 5, 9 or 13."},
                 count(&C::validation_points)},
                {{.name = "model",
                  .explanation =
                      "What is fitted to the targets. `polynomial`: of first order up to 5 targets, "
                      "of second order from 9 on. `homography`: a plane seen from elsewhere."},
                 static_cast<CalibrationModel C::*>(&C::model)},
                {{.name = "accept",
                  .explanation = "By what a target counts as looked at. `fixation`: gaze rested. `key`: the "
                                 "operator pressed the space bar while it did."},
                 static_cast<TargetAcceptance C::*>(&C::accept)},
                {{.name = "area",
                  .low = 0.1,
                  .high = 1,
                  .explanation = "Share of the screen's width and height that the targets span."},
                 number(&C::area)},
                {{.name = "target_deg",
                  .unit = "deg",
                  .low = 0.05,
                  .high = 5,
                  .explanation = "Diameter of a target's disc."},
                 number(&C::target_deg)},
                {{.name = "fixation_s",
                  .unit = "s",
                  .low = 0.05,
                  .high = 5,
                  .explanation = "For so long gaze must rest on a target."},
                 number(&C::fixation_s)},
                {{.name = "fixation_reach_deg",
                  .unit = "deg",
                  .low = 0.05,
                  .high = 10,
                  .explanation =
                      "So far its samples may lie from their median while it rests, but for one in fifty."},
                 number(&C::fixation_reach_deg)},
                {{.name = "patience_s",
                  .unit = "s",
                  .low = 1,
                  .high = 120,
                  .explanation = "So long a target is shown at most; one that was missed comes again once."},
                 number(&C::patience_s)},
                {{.name = "mean_limit_deg",
                  .unit = "deg",
                  .low = 0.01,
                  .high = 45,
                  .explanation =
                      "A validation with a larger mean error is shown to the operator, who decides "
                      "whether to go on; the record says so."},
                 &C::mean_limit_deg},
                {{.name = "max_limit_deg",
                  .unit = "deg",
                  .low = 0.01,
                  .high = 45,
                  .explanation = "The same of the largest error of a target."},
                 &C::max_limit_deg},
                {{.name = "beeps",
                  .explanation =
                      "Sounds while the tracker is set up: a target appeared, it went well, it did "
                      "not. Without a sound device there are none, and it is said."},
                 &C::beeps},
            },
        .home = &Protocol::calibration};
}

Section events() {
    using E = EventDetectionSettings;
    // The thresholds are members of its base.
    const auto of = [](double EventSettings::*threshold) -> double E::* { return threshold; };
    return {
        .name = "events",
        .explanation =
            "Fixations, saccades and blinks in the record, and by which thresholds the program tells them "
            "apart; see [events.md](events.md).",
        .keys =
            {
                {{.name = "method",
                  .explanation =
                      "Who says what the eye did. `tracker`: the eye tracker where it does, else the "
                      "program. `overt`: the program. `none`: neither while the session runs; exports "
                      "then find them with the default thresholds, and say so."},
                 &E::method},
                {{.name = "velocity_deg_s",
                  .unit = "deg/s",
                  .low = 1,
                  .high = 1000,
                  .explanation = "An eye that is faster makes a saccade."},
                 of(&E::velocity_deg_s)},
                {{.name = "acceleration_deg_s2",
                  .unit = "deg/s2",
                  .low = 0,
                  .high = 1e6,
                  .explanation =
                      "Or one whose velocity changes faster; 0: velocity alone decides, which ends "
                      "saccades where people who label raw gaze end them."},
                 of(&E::acceleration_deg_s2)},
                {{.name = "motion_deg",
                  .unit = "deg",
                  .low = 0,
                  .high = 10,
                  .explanation = "What moves the eye less far is no saccade."},
                 of(&E::motion_deg)},
                {{.name = "pursuit_deg_s",
                  .unit = "deg/s",
                  .low = 0,
                  .high = 1000,
                  .explanation =
                      "By so much at most `velocity_deg_s` is raised while the eye moves anyway: by its "
                      "mean speed of the last 40 ms. 0: it stays as it is."},
                 of(&E::pursuit_deg_s)},
                {{.name = "onset_verify_ms",
                  .unit = "ms",
                  .low = 0,
                  .high = 1000,
                  .explanation = "For so long the eye has to be fast for a saccade."},
                 of(&E::onset_verify_ms)},
                {{.name = "offset_verify_ms",
                  .unit = "ms",
                  .low = 0,
                  .high = 1000,
                  .explanation = "For so long it has to be slow for the saccade's end."},
                 of(&E::offset_verify_ms)},
                {{.name = "blink_verify_ms",
                  .unit = "ms",
                  .low = 0,
                  .high = 1000,
                  .explanation = "For so long the pupil has to be there for the end of a blink."},
                 of(&E::blink_verify_ms)},
            },
        .home = &Protocol::events};
}

Section screens() {
    using S = ScreenSettings;
    return {
        .name = "screens",
        .explanation = "What is shown between the animations, and for how long. In every text of a protocol "
                       "that is shown, a first line that begins with `# ` is its title, and `<b>`, `<i>`, "
                       "`<u>`, `<big>` and `<small>` emphasise what stands until `</b>` and so on; `&lt;` "
                       "is a < where it would begin such a mark.",
        .keys =
            {
                {{.name = "task_min_s",
                  .unit = "s",
                  .low = 0,
                  .high = 600,
                  .explanation = "The question stays at least this long before a key goes on."},
                 &S::task_min_s},
                {{.name = "drift_target_s",
                  .unit = "s",
                  .low = 0,
                  .high = 60,
                  .explanation = "How long the target of the drift check is shown."},
                 &S::drift_target_s},
                {{.name = "recording_lead_s",
                  .unit = "s",
                  .low = 0,
                  .high = 10,
                  .explanation =
                      "Gaze is recorded from this long before the animation until this long after."},
                 &S::recording_lead_s},
                {{.name = "response_min_s",
                  .unit = "s",
                  .low = 0,
                  .high = 600,
                  .explanation = "The response screen stays at least this long before a key goes on."},
                 &S::response_min_s},
                {{.name = "response_max_s",
                  .unit = "s",
                  .low = 0.1,
                  .high = 3600,
                  .explanation = "After this long the session goes on without an answer."},
                 &S::response_max_s},
                {{.name = "text_height_deg",
                  .unit = "deg",
                  .low = 0.05,
                  .high = 10,
                  .explanation = "Height of a line of text."},
                 &S::text_height_deg},
                {{.name = "text_grey",
                  .low = 0,
                  .high = 1,
                  .explanation = "Linear grey of the text, 1 being the display's white."},
                 &S::text_grey},
                {{.name = "text_cd_m2",
                  .unit = "cd/m2",
                  .low = 0,
                  .high = 1e5,
                  .if_left_out = "by `text_grey`",
                  .explanation = "The same as a luminance; needs a `characterisation` of the display."},
                 &S::text_cd_m2},
                {{.name = "response_text", .explanation = "Shown while the observer answers aloud."},
                 &S::response_text},
                {{.name = "repeat_question",
                  .explanation = "Whether the trial's question stands above it once more."},
                 &S::repeat_question},
                {{.name = "welcome_text", .explanation = "Shown before the first trial."}, &S::welcome_text},
                {{.name = "farewell_text", .explanation = "Shown after the last trial."}, &S::farewell_text},
            },
        .home = &Protocol::screens};
}

} // namespace overt::key_rows
