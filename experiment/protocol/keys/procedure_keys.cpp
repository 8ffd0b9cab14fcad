#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> procedure() {
    using P = ProcedureSettings;
    return {
        {"id", &P::id, identifier().required(), "Short name, by which a task's `trials` names it."},
        {"kind", &P::kind,
         "constant: each level equally often. staircase: up and down by the answers. quest: the level at the "
         "threshold that is most probable by the answers so far (Watson and Pelli 1983). quest-plus: the "
         "level "
         "whose answer is expected to say most about threshold and slope (Watson 2017)."},
        {"trials", &P::trials, range(1, 2000),
         "How many trials it has in each condition at most, those without an answer included. What is left "
         "over when all procedures of a condition have ended is left out."},
        {"reversals", &P::reversals, range(0, 1000),
         "Of staircase: it ends after so many reversals, if that is earlier; 0: by its trials alone."},
        {"entropy_bits", &P::entropy_bits, range(0, 30).left_out("by its trials alone"),
         "Of quest-plus: it ends when no more uncertainty is left than this, if that is earlier."},
        {"answer", &P::answer, identifier().left_out("the first of the task"),
         "Id of the answer that it reads."},
        {"yes", &P::yes, left_out("`test` beside a standard, else `correct`"),
         "What counts as \"yes\", which lowers the level: `correct`; `test`, the slot that shows the level "
         "that is "
         "chosen; or a choice as the answer has it."},
        {"missed", &P::missed,
         "What a trial without an answer does: the level comes again; it is ignored; or it counts as "
         "\"no\"."},
        {"levels", &P::levels, left_out("all"), "Of constant: the levels that come."},
        {"start", &P::start, left_out("the highest level; of quest the middle one"),
         "Of staircase: the level of the first trial. Of quest: where the threshold is expected."},
        {"up", &P::up, range(1, 20), "Of staircase: so many \"no\" in a row raise the level."},
        {"down", &P::down, range(1, 20), "Of staircase: so many \"yes\" in a row lower it."},
        {"scale", &P::scale,
         "Of staircase: what steps are. places: so many levels further in the series. linear: added. db: "
         "times "
         "10^(step/20). log: times 10^step. Each level that can be reached must be one of the series."},
        {"steps", &P::steps,
         "Of staircase: step sizes; after each reversal the next of them, the last for ever."},
        {"steps_down", &P::steps_down, left_out("as `steps`"),
         "Of staircase: those downwards, where they differ."},
        {"lowest", &P::lowest, left_out("the lowest level"), "Of staircase: limit below."},
        {"highest", &P::highest, left_out("the highest level"), "Of staircase: limit above."},
        {"initial_rule", &P::initial_rule,
         "Of staircase: up to the first reversal each answer changes the level."},
        {"discard", &P::discard, range(0, 100),
         "Of staircase: first reversals that its estimate leaves out."},
        {"guess_sd", &P::guess_sd, range(0.001, 20),
         "Of quest: standard deviation of the guess, log10 units."},
        {"p_threshold", &P::p_threshold, range(0.01, 0.99), "Of quest: share of \"yes\" at threshold."},
        {"beta", &P::beta, range(0.01, 100), "Of quest: slope of the Weibull function over log10."},
        {"delta", &P::delta, range(0, 0.5), "Of quest: share of blind answers."},
        {"guess_rate", &P::guess_rate, range(0, 0.99),
         "Of quest and quest-plus: share of \"yes\" far below threshold; 0.5 with two alternatives."},
        {"function", &P::function, "Of quest-plus: weibull (levels in decibels), normal or logistic."},
        {"thresholds", &P::thresholds, left_out("the levels"),
         "Of quest-plus: grid of thresholds, in decibels with weibull."},
        {"slopes", &P::slopes, left_out("none: quest-plus needs some"),
         "Of quest-plus: grid of slopes; of normal these are standard deviations."},
        {"lapse_rates", &P::lapse_rates, range(0, 0.5), "Of quest-plus: grid of lapse rates."},
    };
}

} // namespace overt::key_rows
