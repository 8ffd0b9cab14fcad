/// What the tables of a study are put together from.
#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "experiment/record/tables/shared_columns.h"
#include "experiment/study/results/study_results.h"

namespace overt {

inline constexpr int usual_decimals = 6, density_decimals = 9;
/// Of places on a mesh.
inline constexpr const char* mesh_unit = "unit of the mesh: mm, unless its own is not known";

/// A table whose columns are added one by one, from left to right. A value is a member of the row, or a
/// function of it.
template <class Row> class StudyLayout : public RowLayout<Row> {
  public:
    StudyLayout(std::string name, std::string description)
        : RowLayout<Row>(std::move(name), std::move(description), {}) {}

    /// A number that may be missing.
    template <class Value>
    void number(std::string name, std::string meaning, std::string unit, Value value,
                int decimals = usual_decimals) {
        column({std::move(name), std::move(meaning), std::move(unit)}, [value, decimals](const Row& row) {
            return Fixed{std::invoke(value, row), decimals};
        });
    }

    /// A whole number; yes and no are 1 and 0.
    template <class Value> void count(std::string name, std::string meaning, Value value) {
        column({std::move(name), std::move(meaning)}, value);
    }

    template <class Value> void text(std::string name, std::string meaning, Value value) {
        column({std::move(name), std::move(meaning)}, [value](const Row& row) {
            const std::string text{std::invoke(value, row)};
            return text == "n/a" ? std::string() : text;
        });
    }

    /// The value of an Estimate, both ends of its interval, and why there is none.
    template <class Of>
    void estimate(const std::string& name, const std::string& meaning, const std::string& unit, Of of) {
        const auto end = [of](double Interval::*which) {
            return [of, which](const Row& row) { return of_maybe(std::invoke(of, row).interval, which); };
        };
        number(name, meaning, unit, [of](const Row& row) { return std::invoke(of, row).value; });
        number(name + "_low", "Lower end of the interval of confidence of " + name, unit,
               end(&Interval::low));
        number(name + "_high", "Upper end of the interval of confidence of " + name, unit,
               end(&Interval::high));
        text(name + "_absent", "Why there is no " + name + "; n/a: there is one",
             [of](const Row& row) { return std::invoke(of, row).absent; });
    }

    /// What speaks for an effect and for none; names begin with `prefix`, and `what` was tested.
    template <class Of> void evidence(const std::string& prefix, const std::string& what, Of of) {
        estimate(prefix + "effect_size",
                 "Mean over standard deviation of observers' " + what + " (Hedges' g of d_z)", "",
                 [of](const Row& row) { return std::invoke(of, row).effect_size; });
        number(prefix + "bayes_factor",
               "BF10 of the " + what +
                   " (JZS, scale 0.707): above 3 it speaks for an effect, below 1/3 for none",
               "", [of](const Row& row) { return std::invoke(of, row).bayes_factor; });
        number(prefix + "equivalence_p",
               "Of two one-sided tests that the effect is not smaller than smallest-effect: where it is "
               "small, the effect is shown to be smaller",
               "", [of](const Row& row) { return std::invoke(of, row).equivalence_p; });
    }

    /// A column for each column of the groups; what a row leaves open is "all".
    template <class Keys> void keys(const std::vector<std::string>& by, Keys keys) {
        for (const std::string& name : by)
            text(name, "The group's " + name + "; all: any", [name, keys](const Row& row) -> std::string {
                const std::vector<StudyKey>& own = std::invoke(keys, row);
                const auto found = std::ranges::find(own, name, &StudyKey::column);
                return found == own.end() ? "all" : found->value;
            });
    }

    /// The object with this index. `results` must outlive the layout, as in the next.
    template <class Index>
    void object(const StudyResults& results, Index index,
                std::string meaning = "The object on whose surface this is") {
        text("on_object", std::move(meaning),
             [&results, index](const Row& row) { return item(results.objects, std::invoke(index, row)).id; });
    }

    /// The keys of the row's group, and the object that it is of.
    void group_and_object(const StudyResults& results) {
        keys(
            results.by, [&results](const Row& row) -> auto& { return item(results.groups, row.group).keys; });
        object(results, &Row::object);
    }

  private:
    /// Lengths are the object's own, and their units say so.
    template <class Value> void column(TableColumn what, Value value) {
        if (what.unit.find("mm") != std::string::npos)
            what.unit += " of the object";
        this->template add<Row>({{std::move(what), std::move(value)}});
    }
};

} // namespace overt
