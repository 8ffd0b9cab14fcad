/// The port of the keys and buttons that observer and operator press.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/ports/observer_input.h"
#include "experiment/ports/session_phase.h"
#include "experiment/ports/setup_screen.h"
#include "experiment/ports/turning_offer.h"
#include "experiment/session_time.h"
#include "experiment/trial.h"

namespace overt {

/// A key or button with which the observer or the operator answers.
struct ResponsePress {
    enum class Key : std::uint8_t {
        next,
        back,
        // Of a decision.
        yes,
        no,
        // Of an entry; digits of a decision, too, are characters.
        character,
        erase,
        up,
        down,
        left,
        right,
        // The operator's.
        pause,
        recalibrate,
        drift_check, ///< now, besides those of the protocol
        repeat,      ///< the trial that is running, at once
        reject,      ///< the same, when the protocol says
        skip,        ///< the trial: it does not come again
        abort,       ///< the session
    };
    Key key = Key::next;
    SessionTime pressed_at;
    char32_t character = 0;
    /// The press came so long before pressed_at at most. Of a keyboard, which is looked at now and then; the
    /// record of a response box has its own.
    SessionDuration uncertainty{};
};
constexpr bool is_operators(ResponsePress::Key key) { return key >= ResponsePress::Key::pause; }

/// An operator's key as [operator] and the record call it; empty for the observer's.
template <>
inline constexpr auto
    names_of<ResponsePress::Key> = enum_names<ResponsePress::Key>("", "", "", "", "", "", "", "", "", "",
                                                                  "pause", "recalibrate", "drift check",
                                                                  "repeat", "reject", "skip", "abort");

class SessionLog;
struct AnswerOffer;

/// What the next press is to be.
enum class Awaited : std::uint8_t {
    key,      ///< a text is being read until a key is pressed
    response, ///< the question of a trial is to be answered
    consent,  ///< yes or no: the observer decides whether to take part
    decision, ///< yes or no, or a digit, of the operator
    entry,    ///< a form is being filled in: keys of letters are letters
    setup,    ///< a tracker is set up: keys are told as they are, by next_setup_key()
    answer    ///< answers are given: what the observer does is told as it is, by next_input()
};

/// Keys that the operator pressed are never forgotten, whatever is waited for.
class ResponsePanel {
  public:
    virtual ~ResponsePanel() = default;
    /// Forgets earlier presses. `trial`: whose question is to be answered from now on; null for all else.
    virtual void await(Awaited what, SessionTime since, const Trial* trial) = 0;
    void await_key(SessionTime since) { await(Awaited::key, since, nullptr); }
    void await_response(const Trial& trial, SessionTime since) { await(Awaited::response, since, &trial); }
    void await_decision(bool is_consent, SessionTime since) {
        await(is_consent ? Awaited::consent : Awaited::decision, since, nullptr);
    }
    void await_entry(SessionTime since) { await(Awaited::entry, since, nullptr); }
    void await_answer(SessionTime since, const Trial* trial) { await(Awaited::answer, since, trial); }
    /// What can be answered from now on, in turn: for an observer who does not see the screen. Before
    /// await_answer(), and again when a page is answered. `window_opened`: presses count from `at` on; it is
    /// called in presentations, so it allocates and throws nothing.
    virtual void offer(const std::vector<AnswerOffer>& /*answers*/) {}
    virtual void window_opened(SessionTime /*at*/) noexcept {}
    /// An object can be turned, for such an observer; after await_answer().
    virtual void offer_turning(const TurningOffer& /*turning*/) {}
    void await_setup(SessionTime since) { await(Awaited::setup, since, nullptr); }
    virtual std::optional<SetupKey> next_setup_key() { return std::nullopt; }
    /// While an answer is awaited, the next of what the observer did, in the order of each device. Poll
    /// first: that is where devices are looked at, and where the operator's keys come out. Allocates and
    /// throws nothing: it is called during presentations.
    virtual std::optional<ObserverInput> next_input() noexcept { return std::nullopt; }
    /// The next press, if there was one. Allocates and throws nothing: it is called during presentations.
    virtual std::optional<ResponsePress> poll() noexcept = 0;
    /// Whether what is typed comes here; false once it has gone to another window. Told by poll().
    virtual bool has_keyboard() const noexcept { return true; }
    /// What was said or typed in answer, once the press has come; empty if the panel takes none.
    virtual std::string answer() = 0;
    /// What the operator should know once the session has ended, a line each.
    virtual std::vector<std::string> closing_warnings() const { return {}; }
    /// Records what its buttons did and what became of its devices since it was asked last. Asked often, but
    /// not during presentations. Throws as SessionLog does.
    virtual void write_down(SessionLog& /*log*/) {}
    /// The session has come to this phase; `trial` is -1 outside of trials.
    virtual void entered(SessionPhase /*phase*/, int /*trial*/) noexcept {}
};

} // namespace overt
