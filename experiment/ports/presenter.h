/// The port through which a session shows pictures and texts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/flip_report.h"
#include "experiment/ports/answer_view.h"
#include "experiment/ports/setup_screen.h"
#include "experiment/ports/stimulus_mark.h"
#include "experiment/session_time.h"
#include "experiment/swap_modes.h"
#include "experiment/trial.h"

namespace overt {

/// A key that works on a screen, and what it does.
struct KeyHint {
    std::string key, does;
};

/// A line of a form: a label, and beside it what is typed or the choices that there are.
struct FormRow {
    std::string label;
    std::string value;                  ///< what is typed; of a choice, the one that is chosen, or empty
    std::vector<std::string> choices;   ///< empty: a value is typed
    std::vector<std::string> ends = {}; ///< words before the first of the choices and after the last, or none
    bool is_here = false;               ///< it is being filled in
    bool is_at_fault = false;           ///< what stands there cannot stay
};

/// A screen that is not a stimulus. All words are UTF-8.
struct Screen {
    enum class Kind : std::uint8_t {
        blank,
        text,
        form,
        target,     ///< to be looked at
        validation, ///< where gaze was measured beside the targets; `text` below
        camera,     ///< what a tracker's camera sees
        noise,      ///< squares of random light where stimuli stand
        scrambled,  ///< squares of what was shown last where they stand, in another order
        answers     ///< what is answered, and how; `text` above its items
    };
    Kind kind = Kind::blank;
    /// For text and form; paragraphs split by newlines, emphasis by <b>, <i>, <u>, <big> and <small>. A first
    /// line that begins with "# " is the title. Of a form, its title and what is said below its rows.
    std::string text;
    std::vector<FormRow> rows = {}; ///< of a form
    std::vector<KeyHint> keys = {}; ///< set apart at the foot
    int page = 0, pages = 0;        ///< how far this is, from 1; of none, no line is drawn
    std::string frame = {}; ///< whom it is for, if not for the observer: then a frame is drawn around it
    std::optional<ScreenPoint> target_place = {}; ///< its middle; nothing: the middle of the screen
    Degrees target_diameter{0.6};                 ///< of the disc of the fixation target (Thaler et al. 2013)
    std::vector<ValidatedTarget> validated = {};
    CameraImage camera = {};
    std::uint64_t noise_seed = 0;
    Degrees noise_cell{0.25}; ///< side of a square, at the middle of the screen
    /// Of what is loaded, where noise and squares are; none: where the only stimulus stands.
    std::vector<int> places = {};
    AnswerView answers = {};
};

/// How the display shows things: known once the presenter is open.
struct DisplayTiming {
    double refresh_hz = 0.0; ///< nominal
    VblankSource source = VblankSource::virtual_display;
};

/// A level meter of the microphone; lengths are shares of the whole bar.
struct LevelBar {
    double mean = 0.0, peak = 0.0;
    std::string warning; ///< UTF-8; empty: nothing is wrong
    bool operator==(const LevelBar&) const = default;
};

/// Shows pictures at refreshes of the display. Loading may take long and throw; flipping does neither.
class Presenter {
  public:
    virtual ~Presenter() = default;

    virtual DisplayTiming timing() const = 0;

    /// Puts the frames of these stimuli into the frame store, replacing those loaded before; each will be
    /// shown in its slot. Throws GraphicsError or InputError.
    virtual void load_slots(std::span<const PlacedStimulus> shown) = 0;
    /// The same of one stimulus, in the first slot.
    void load_frames(const Stimulus& stimulus) {
        const PlacedStimulus only{stimulus};
        load_slots({&only, 1});
    }

    /// What will be loaded next: a presenter may begin with it now, in the background.
    virtual void expect_slots(std::span<const PlacedStimulus> /*shown*/) noexcept {}
    /// Called repeatedly while the screen stands still: a presenter may use a few milliseconds for work that
    /// it has put off.
    virtual void use_spare_time() noexcept {}

    /// Draws a screen and shows it at the next refresh; it stays until the next call. Lays out text, so not
    /// for use between a presentation's first and last flip.
    virtual FlipReport show(const Screen& screen) = 0;

    /// From now on these answers stand on the screen with every stimulus, where their up_deg says, and what
    /// the slots cover of them is not seen; they stay as they are. The mouse's pointer is seen there if they
    /// are answered with it. Null: no longer. Lays out text: not between a presentation's first and last
    /// flip. Throws as show() does.
    virtual void put_beside_stimuli(const AnswerView* /*answers*/) {}

    /// What of the answers on the screen that was shown last, or that stand beside the stimulus, lies at this
    /// place, from the middle of the screen in pixels of the display: decided by where it was drawn. Nothing
    /// on any other screen.
    virtual AnswerPlace place_in_answers(double /*right_px*/, double /*down_px*/) const noexcept {
        return {};
    }

    /// Draws a level meter below the middle of the screen that is shown, at the next refresh. Not for use
    /// between a presentation's first and last flip.
    virtual void show_level(const LevelBar& /*bar*/) {}

    /// Shows a frame of each loaded stimulus in its slot at the next refresh, of all at the same one, and
    /// returns when that refresh has begun; no_frame leaves a slot empty. `frames` are as many as were
    /// loaded, in their order. Allocates, opens and throws nothing.
    virtual FlipReport flip_slots(std::span<const AnimationFrameIndex> frames) noexcept = 0;
    /// The same of the only stimulus.
    FlipReport flip(AnimationFrameIndex frame) noexcept { return flip_slots({&frame, 1}); }

    /// From the next flip on, these stand over the stimuli until they are given anew; over no other screen.
    /// At most `most_marks`. Throws nothing, and allocates nothing for a light that was given before: each is
    /// given once before a presentation begins. `of_other_eye`: the same as the eye that is not analysed has
    /// them; empty where both eyes see one picture.
    virtual void mark_stimuli(std::span<const StimulusMark> /*marks*/,
                              std::span<const StimulusMark> /*of_other_eye*/) noexcept {}
    void mark_stimuli(std::span<const StimulusMark> marks) noexcept { mark_stimuli(marks, {}); }
    static constexpr std::size_t most_marks = 8;

    /// Raises these digital outputs of the display box, a bit each, with the refresh that the next flip()
    /// lights, for this long; in the modes that carry them, else nothing. Allocates and throws nothing.
    virtual void raise_with_next_flip(std::uint16_t /*outputs*/, double /*pulse_ms*/) noexcept {}

    /// From now on the display gets a dark picture in the place of each that is drawn, and none of its
    /// messages: drawing takes the time that it takes, and nothing of it is seen. Not for use between a
    /// presentation's first and last flip.
    virtual void veil(bool /*is_on*/) {}

    /// How the pictures shown since the last call came to the screen; nothing where no server tells it. May
    /// wait for the server: not for use between a presentation's first and last flip.
    virtual std::optional<SwapModes> take_swap_modes() noexcept { return {}; }

    /// The window was closed or the display went away. The session ends the trial and then itself.
    virtual bool closed() const noexcept = 0;

    /// Why, once closed(): what follows "the session ended early: ".
    virtual std::string why_closed() const { return "the display was closed"; }
};

} // namespace overt
