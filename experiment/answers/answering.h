/// One thing that is answered, while it is: inputs go in, what it looks like and what it means come out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/answers/task_answer.h"
#include "experiment/attitude.h"
#include "experiment/ports/answer_offer.h"
#include "experiment/ports/answer_view.h"
#include "experiment/ports/observer_input.h"

namespace overt {

/// What a match can be set to in one trial: all combinations of the values of its columns.
struct MatchLevels {
    struct Axis {
        std::string along;                    ///< the column
        std::vector<double> values;           ///< rising
        int start = 0;                        ///< index of the value that it begins with
        std::optional<double> reference = {}; ///< of the first other stimulus that has one
    };
    std::vector<Axis> axes;        ///< none: it is no match
    std::vector<Stimulus> stimuli; ///< by level: with two axes the second runs faster
    int place = 0;                 ///< of the stimulus that is set, in Trial::shown
    int slot = 0;                  ///< of the protocol
    int level_of(int first, int second = 0) const {
        return axes.size() < 2 ? first : first * static_cast<int>(axes[1].values.size()) + second;
    }
};

/// An answer as it is asked in one trial.
struct AnswerForm {
    const TaskAnswer* settings = nullptr; ///< of the protocol, which outlives it
    std::string item;                     ///< of a scale with several
    std::vector<std::string> labels;      ///< of its choices as the observer reads them, as they are written
    int mapping = 0;                      ///< choices begin with this one; of a scale, 1 turns it round
    std::string correct;                  ///< a value; empty: none
    int place = 0;                        ///< which of the trial's it is in turn
    std::string probe = {}, point = {};   ///< of a gauge: where it stands
    Attitude start = {};                  ///< of a gauge, drawn
    MatchLevels levels = {};              ///< of a match
};

class Answering {
  public:
    explicit Answering(const AnswerForm& form) : form_(form) {}
    virtual ~Answering() = default;

    enum class Effect : std::uint8_t {
        none,
        touched, ///< what it looks like changed, and it says nothing yet
        changed, ///< it says something else
        chosen,  ///< likewise, and that is an answer where none has to be accepted
        accepted ///< what it says is to stand, as by the key that accepts
    };
    /// What the observer did, in its window and with it: a press that was not held before, and of the mouse
    /// what began at a place in this step; `place` is where the pointer is. Allocates and throws nothing.
    virtual Effect take(const ObserverInput& input, const AnswerPlace& place) noexcept = 0;
    /// It says something.
    virtual bool has_value() const noexcept = 0;
    /// What it says can stand.
    virtual bool is_sound() const noexcept { return true; }
    /// As it is recorded; of has_value() alone.
    virtual std::string value() const = 0;
    /// Of a scale where its marker stands, of a number what was typed; allocates nothing.
    virtual std::optional<double> number() const noexcept { return std::nullopt; }
    /// It is given with the mouse on the stimulus itself, whose pointer is seen there.
    virtual bool points() const noexcept { return false; }
    /// Of a gauge, how it is turned now, which stands on the stimulus; allocates nothing.
    virtual std::optional<Attitude> attitude() const noexcept { return std::nullopt; }
    /// Of a match: the level that its slot shows; allocates nothing.
    virtual std::optional<int> level() const noexcept { return std::nullopt; }
    /// What the record has of it besides value and number; also where it was missed.
    virtual void add_details(GivenAnswer& /*given*/) const {}
    /// All but the question.
    virtual void draw(AnswerItem& item) const = 0;
    /// How it can be given; all but id, item, kind, correct, and the key that accepts.
    virtual void offer(AnswerOffer& offer) const = 0;

    const AnswerForm& form() const { return form_; }
    const TaskAnswer& settings() const { return *form_.settings; }

  protected:
    AnswerForm form_;
};

} // namespace overt
