#include "experiment/events/event_thresholds.h"
#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

namespace {

constexpr std::string_view eyes[] = {"left", "right", "both"};

/// What each tracker of a session has, as members of `T`: TrackerSettings, or what is made from it.
template <class T> std::vector<Key> tracker_keys() {
    return {
        {"kind", member_of<T>(&T::kind), explanation_of_kinds<TrackerKind>("Which eye tracker.")},
        {"rate_hz", member_of<T>(&T::rate_hz), range(10, 10000, "Hz"), "Gaze samples per second."},
        {"address", member_of<T>(&T::address), left_out("what is usual for the kind"),
         "Where the tracker is. `eyelink`: address of its host, or `dummy` to try the library without one. "
         "`opengaze` and `pupil`: host or host:port. `lsl`: name of the stream, or what else tells it, such "
         "as "
         "`source_id=…, host=…, uid=…, type=…`. `tobii`: its address "
         "(tet-tcp://…) or serial number. `hid`: /dev/hidrawN, or vendor:product. `replay`: a session's "
         "folder, or an EyeLink recording (.asc)."},
        {"outlet", member_of<T>(&T::outlet),
         "Whether samples are also sent on as a stream \"overt gaze\" of the Lab Streaming Layer, of "
         "trackers that measure in real time."},
        {"point", member_of<T>(&T::point),
         "Of `opengaze`, which point of gaze is taken. `eyes`: each eye's own. `best`: the mean of both, or "
         "that of the one that is found."},
        {"surface", member_of<T>(&T::surface),
         "Of `pupil`, the surface in Pupil Capture that is the screen."},
        {"least_confidence", member_of<T>(&T::least_confidence), range(0, 1),
         "Of `pupil`, and of streams that tell confidence: gaze of less is lost."},
        {"channels", member_of<T>(&T::channels), left_out("what the stream tells"),
         "Of `lsl`, what the stream's channels mean: eye (or none), meaning, and the channel's label or its "
         "number from 1, such as `[\"left x 1\", \"left y 2\", \"right pupil PupilRight\"]`. Meanings are x, "
         "y, confidence, pupil, eye-x, eye-y, eye-z, valid (0: there is no gaze)."},
        {"unit", member_of<T>(&T::unit),
         "Of `lsl`, the unit of gaze: pixels, or shares of the screen, of one or of a hundred."},
        {"y_is_up", member_of<T>(&T::y_is_up),
         "Of `lsl`, whether y grows upward from the lower edge of the screen."},
        {"missing", member_of<T>(&T::missing), left_out("those of programs that are known, and none else"),
         "Of `lsl`, numbers that stand for a value that there is not, such as `[-32768]`; NaN always does. "
         "Gaze "
         "is missing where one of its coordinates is such a number that lies off the screen, or both are "
         "such "
         "numbers."},
        {"eye", member_of<T>(&T::eye), one_of(eyes),
         "The eye that is tracked. Of both, the right one is analysed."},
        {"simulated_noise_deg", member_of<T>(&T::simulated_noise_deg), range(0, 10, "deg"),
         "Standard deviation of each simulated sample."},
        {"simulated_accuracy_deg", member_of<T>(&T::simulated_accuracy_deg), range(0, 10, "deg"),
         "Standard deviation of the constant error of a simulated trial."},
        {"simulated_clock_drift_ppm", member_of<T>(&T::simulated_clock_drift_ppm),
         range(-10000, 10000, "ppm"),
         "How much faster the simulated tracker's clock runs than the session's."},
    };
}

} // namespace

std::vector<Key> display() {
    using D = DisplaySettings;
    return {
        {"width_px", &D::width_px, range(16, 16384, "px"), "Pixels in a row of the screen."},
        {"height_px", &D::height_px, range(16, 16384, "px"), "Rows of the screen."},
        {"refresh_hz", &D::refresh_hz, range(1, 1000, "Hz"),
         "Refresh rate; to within 0.2 % a whole multiple of `animation.frame_rate_hz`, so that every frame "
         "is lit equally long: at 59.94 Hz a frame of 30 Hz is held for two refreshes, which is 29.97 frames "
         "a second, and 8 s last 8.008 s."},
        {"width_mm", &D::width_mm, range(10, 20000, "mm"),
         "Width of the lit area, by which visual angles are reckoned."},
        {"height_mm", &D::height_mm, range(10, 20000, "mm"), "Height of the lit area."},
        {"viewing_distance_mm", &D::viewing_distance_mm, range(50, 50000, "mm"),
         "From the observer's eye to the middle of the screen."},
        {"output", &D::output, one_of(names_in<output_modes>),
         "How light is packed into the video signal: 8 or 10 bits per channel for any display, the 16-bit "
         "modes of a Display++, or those of VPixx devices. `color++` and `vpixx-c48` join pixels in pairs; "
         "see [output.md](output.md)."},
        {"dither", &D::dither,
         "How the native modes spread what lies between two of their levels over neighbouring pixels and "
         "refreshes."},
        {"pair_filter", &D::pair_filter,
         "How pixels become the one colour of a pair, in linear light: the mean of the two, or a Lanczos "
         "filter over twelve."},
        {"monitor", &D::monitor,
         "Which of several monitors the observer sees: the name of its output, such as `DP-1`, or the one in "
         "its EDID, such as `Display++`, or its number; `overt doctor` lists all three. Without it, the only "
         "one of this size, or of this size and rate. A session is refused where that leaves none or "
         "several. `--monitor` goes before it."},
        {"box", &D::box,
         "The Display++ or Bits# that shows `mono++`, `color++` and `bits++`: `auto` looks for it on the USB "
         "serial ports, a path such as `/dev/ttyACM0` names its port, and with `none` its mode is not "
         "switched and it is not asked anything. Sessions on a real screen in real time need it; see "
         "[display_plus_plus.md](display_plus_plus.md)."},
        {"onset_trigger", &D::onset_trigger, range(0, 16777215),
         "Digital outputs that the first refresh of a presentation raises, as a sum of 1, 2, 4 …; 0 for "
         "none. A Display++ has ten (up to 1023) and raises them for 5 ms; a VPixx device in its Pixel Mode "
         "has 24 and raises them for the refresh; see [output.md](output.md)."},
        {"timing", &D::timing,
         "With `proven`, a session in a window in real time is refused where no real vertical blank tells "
         "when its pictures are lit. With `unproven` it runs, and its record, its exports and reports say "
         "that times and missed refreshes are unproven. Of no effect in virtual time and without a window; "
         "see [vblank_sources.md](vblank_sources.md)."},
        {"photodiode", &D::photodiode,
         "A square in this corner that changes between white and black with each frame of the animation, "
         "white first, for a photodiode; black otherwise. It stands below the rows that carry messages."},
        {"photodiode_px", &D::photodiode_px, range(2, 1000, "px"), "Side of that square."},
        {"tags_px", &D::tags_px, range(0, 1000, "px"),
         "Side of the AprilTags (tag36h11, 0 to 5) that stand in the corners of the screen, and in the "
         "middle of its left and right edge where there is room, for eye trackers with a scene camera; a "
         "multiple of 10, or of 20 where the output joins pixels in pairs. 0 for none. See "
         "[trackers.md](trackers.md)."},
        {"tags_light", &D::tags_light, range(0.02, 1),
         "Light of their white modules, as a share of the display's white; the black ones have none."},
        {"gamma", &D::gamma, range(0.1, 5),
         "Exponent from signal to light: 1 for a display that linearises itself, about 2.2 for an ordinary "
         "monitor."},
        {"linearised_by", &D::linearised_by,
         "What makes light proportional to the signal. `display`: the panel itself. `box`: the display box, "
         "by `box_gamma_table`. `none`: nothing, and overt corrects for `gamma`. Sessions on a real screen "
         "in real time need one of these, or a `characterisation`; the first two leave `gamma` at 1."},
        {"box_gamma_table", &D::box_gamma_table,
         "The table that the display box is told to use, a file on its disk. `13bitLinearLUT.txt` leaves "
         "values as they are."},
        {"video_check_days", &D::video_check_days, range(0, 3650, "days"),
         "So old may the last `overt display verify --hardware` be before a session that goes through a "
         "display box: it proves, for one box, graphics card, driver, output and mode, that the bytes arrive "
         "as they are drawn. 0: none is asked for, and the record says so."},
        {"characterisation", &D::characterisation_file, left_out("none"),
         "File with what was measured of the display, instead of `gamma`: primaries, black, and the curve of "
         "each channel; see [characterisation.md](characterisation.md)."},
        {"latency_ms", &D::latency_ms, range(0, 1000, "ms"),
         "From the vertical blank to the light of the first row."},
        {"background", &D::background, range(0, 1),
         "Linear grey around the stimulus, 1 being the display's white."},
        {"frame_store_mb", &D::frame_store_mb, range(1, 1000000, "MB"),
         "What the frames of the shown stimulus and of the next may take on the graphics card. If both do "
         "not fit, the next is loaded before its trial instead of during the answer before. A stimulus that "
         "does not fit alone comes from disk while it is shown, if at least 8 of its pictures fit and they "
         "are shown in order; `overt check` measures whether that is fast enough."},
        {"background_cd_m2", &D::background_cd_m2, range(0, 1e5, "cd/m2").left_out("by `background`"),
         "The same as a luminance; needs a `characterisation`."},
    };
}

std::vector<Key> stereo() {
    using S = StereoSettings;
    return {
        {"kind", &S::kind,
         "`mirrors`: each eye has half of the screen, seen through a stereoscope. `frame-sequential`: both "
         "have the whole screen in turn, through shutter glasses that the graphics card drives (quad "
         "buffers). `none`: both see the same."},
        {"interocular_mm", &S::interocular_mm, range(20, 90, "mm"),
         "Between the middles of the observer's pupils: so far apart stand the two cameras."},
        {"swapped", &S::swapped, "Of `mirrors`: the right eye sees the left half."},
        {"mirrored", &S::mirrored,
         "Left and right are exchanged in each half, for a stereoscope with one mirror to an eye. Only in "
         "outputs that do not join pixels in pairs."},
        {"left_eye_right_px", &S::left_eye_right_px, range(-4000, 4000, "px"),
         "Of `mirrors`: how far the left eye's picture stands to the right of its place in its half. "
         "`overt display stereo` finds these four."},
        {"left_eye_down_px", &S::left_eye_down_px, range(-4000, 4000, "px"), "And how far below it."},
        {"right_eye_right_px", &S::right_eye_right_px, range(-4000, 4000, "px"),
         "The same of the right eye's picture."},
        {"right_eye_down_px", &S::right_eye_down_px, range(-4000, 4000, "px"), "And how far below it."},
        {"largest_disparity_arcmin", &S::largest_disparity_arcmin, range(1, 1200, "arcmin"),
         "Beyond it `check` warns. A degree is a rule of thumb for what most people fuse with ease."},
    };
}

std::vector<Key> tracker() {
    using T = TrackerSettings;
    std::vector<Key> keys = tracker_keys<T>();
    const std::vector<Key> drift{
        {"drift_limit_deg", &T::drift_limit_deg, range(0.01, 45, "deg"),
         "A drift check that finds a larger error, or no eye, has failed. The record says so."},
        {"on_drift", &T::on_drift,
         "What becomes of a trial whose drift check failed. `note`: it is presented all the same. `retry`: "
         "the target is shown again. `recalibrate`: the tracker is calibrated, and the trial begun anew. "
         "`reject`: it is not presented, and comes again as `[repeat] rejected` says."},
        {"drift_checks", &T::drift_checks, range(1, 20),
         "Of a trial, with `retry` and `recalibrate`. If the last fails, too, it is presented all the same."},
    };
    keys.insert(keys.end(), drift.begin(), drift.end());
    return keys;
}

std::vector<Key> further_tracker() {
    using F = FurtherTrackerSettings;
    std::vector<Key> keys = tracker_keys<F>();
    keys.insert(keys.begin(), {"id", &F::id, identifier().required(),
                               "By which its record is named: `trackers/ID` in the session's folder."});
    return keys;
}

std::vector<Key> calibration() {
    using C = CalibrationKeys;
    return {
        {"by", &C::by,
         "Who calibrates. `auto`: the tracker where it can, else the program. `tracker`: the tracker. "
         "`overt`: the program, on top of what the tracker measures."},
        {"points", member_of<C>(&C::points), "Targets of a calibration by the program: 3, 5, 9 or 13."},
        {"validation_points", member_of<C>(&C::validation_points),
         "Targets of its validation, at other places: 3, 5, 9 or 13."},
        {"model", member_of<C>(&C::model),
         "What is fitted to the targets. `polynomial`: of first order up to 5 targets, of second order from "
         "9 on. `homography`: a plane seen from elsewhere."},
        {"accept", member_of<C>(&C::accept),
         "By what a target counts as looked at. `fixation`: gaze rested. `key`: the operator pressed the "
         "space bar while it did."},
        {"area", member_of<C>(&C::area), range(0.1, 1),
         "Share of the screen's width and height that the targets span."},
        {"target_deg", member_of<C>(&C::target_deg), range(0.05, 5, "deg"), "Diameter of a target's disc."},
        {"fixation_s", member_of<C>(&C::fixation_s), range(0.05, 5, "s"),
         "For so long gaze must rest on a target."},
        {"fixation_reach_deg", member_of<C>(&C::fixation_reach_deg), range(0.05, 10, "deg"),
         "So far its samples may lie from their median while it rests, but for one in fifty."},
        {"patience_s", member_of<C>(&C::patience_s), range(1, 120, "s"),
         "So long a target is shown at most; one that was missed comes again once."},
        {"mean_limit_deg", &C::mean_limit_deg, range(0.01, 45, "deg"),
         "A validation with a larger mean error is shown to the operator, who decides whether to go on; the "
         "record says so."},
        {"max_limit_deg", &C::max_limit_deg, range(0.01, 45, "deg"),
         "The same of the largest error of a target."},
        {"beeps", &C::beeps,
         "Sounds while the tracker is set up: a target appeared, it went well, it did not. Without a sound "
         "device there are none, and it is said."},
    };
}

std::vector<Key> events() {
    using E = EventDetectionSettings;
    std::vector<Key> keys{
        {"method", &E::method,
         "Who says what the eye did. `tracker`: the eye tracker where it does, else the program. `overt`: "
         "the program. `none`: neither while the session runs; exports then find them by thresholds that "
         "go with the gaze's rate and noise, and say so."},
    };
    for (const EventThreshold& threshold : event_thresholds)
        keys.emplace_back(threshold.key, member_of<E>(threshold.setting),
                          range(threshold.least, threshold.most, threshold.unit), threshold.what);
    return keys;
}

std::vector<Key> screens() {
    using S = ScreenSettings;
    return {
        {"task_min_s", &S::task_min_s, range(0, 600, "s"),
         "The question stays at least this long before a key goes on."},
        {"drift_target_s", &S::drift_target_s, range(0, 60, "s"),
         "How long the target of the drift check is shown."},
        {"recording_lead_s", &S::recording_lead_s, range(0, 10, "s"),
         "Gaze is recorded from this long before the animation until this long after."},
        {"response_min_s", &S::response_min_s, range(0, 600, "s"),
         "The response screen stays at least this long before a key goes on."},
        {"response_max_s", &S::response_max_s, range(0.1, 3600, "s"),
         "After this long the session goes on without an answer."},
        {"text_height_deg", &S::text_height_deg, range(0.05, 10, "deg"), "Height of a line of text."},
        {"text_grey", &S::text_grey, range(0, 1), "Linear grey of the text, 1 being the display's white."},
        {"text_cd_m2", &S::text_cd_m2, range(0, 1e5, "cd/m2").left_out("by `text_grey`"),
         "The same as a luminance; needs a `characterisation` of the display."},
        {"response_text", &S::response_text, "Shown while the observer answers aloud."},
        {"repeat_question", &S::repeat_question, "Whether the trial's question stands above it once more."},
        {"welcome_text", &S::welcome_text, "Shown before the first trial."},
        {"farewell_text", &S::farewell_text, "Shown after the last trial."},
    };
}

} // namespace overt::key_rows
