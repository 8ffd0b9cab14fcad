#include "experiment/design/drawn_lists.h"

#include <algorithm>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/stimulus_lists.h"

namespace overt {

namespace {

/// `count` of them (all, if there are no more), in their order.
std::vector<int> drawn_of(std::vector<int> entries, std::optional<int> count, RandomStream& random) {
    if (!count || static_cast<std::size_t>(*count) >= entries.size())
        return entries;
    std::vector<int> shuffled = entries;
    random.shuffle(std::span(shuffled));
    shuffled.resize(static_cast<std::size_t>(*count));
    std::erase_if(entries, [&](int entry) { return std::ranges::find(shuffled, entry) == shuffled.end(); });
    return entries;
}

} // namespace

bool DrawnList::is_old(int entry) const { return std::ranges::find(old, entry) != old.end(); }

void mark_old_and_new(const DrawnList& drawn, std::vector<Trial>& trials) {
    if (!drawn.tells_old_from_new)
        return;
    for (Trial& trial : trials) {
        const bool is_old = drawn.is_old(trial.stimulus.*stimulus_lists[drawn.list].index);
        trial.levels.push_back({"seen", is_old ? "old" : "new"});
        if (trial.correct.empty())
            trial.correct = trial.levels.back().level;
    }
}

std::optional<std::size_t> list_called(std::string_view name) {
    const auto found = std::ranges::find(stimulus_lists, name, &StimulusList::name);
    return found == stimulus_lists.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - stimulus_lists.begin()));
}

int block_called(const Protocol& protocol, std::string_view id) {
    const auto found = std::ranges::find(protocol.blocks, id, &BlockSettings::id);
    return found == protocol.blocks.end() ? -1 : static_cast<int>(found - protocol.blocks.begin());
}

std::optional<DrawnList> drawn_list(const Protocol& protocol, const std::vector<BlockScopeOf>& scopes,
                                    int block, int observer_number, std::uint64_t seed) {
    const DrawSettings& settings = block_at(protocol, block).draw;
    const auto scope = std::ranges::find(scopes, block, &BlockScopeOf::block);
    if (!settings.is_written() || scope == scopes.end())
        return std::nullopt;
    DrawnList drawn{list_called(settings.of).value(), {}, {}, !settings.from.empty()};
    const std::vector<int>& all = scope->scope.lists[drawn.list];
    const std::string purpose = "list of block " + block_at(protocol, block).id;
    RandomStream random =
        settings.per == DrawnFor::everyone
            ? RandomStream(static_cast<std::uint64_t>(protocol.schedule.rotation_seed), purpose)
            : RandomStream(seed, purpose, static_cast<std::uint64_t>(observer_number));
    if (!drawn.tells_old_from_new) {
        drawn.entries = drawn_of(all, settings.count, random);
        return drawn;
    }
    const int before = block_called(protocol, settings.from);
    OVERT_EXPECTS(before >= 0 && before != block);
    std::vector<int> old, others;
    const auto known = drawn_list(protocol, scopes, before, observer_number, seed);
    for (const int entry : all)
        (known && std::ranges::find(known->entries, entry) != known->entries.end() ? old : others)
            .push_back(entry);
    drawn.old = drawn_of(old, settings.old_entries, random);
    const std::vector<int> fresh = drawn_of(others, settings.new_entries, random);
    for (const int entry : all)
        if (drawn.is_old(entry) || std::ranges::find(fresh, entry) != fresh.end())
            drawn.entries.push_back(entry);
    return drawn;
}

} // namespace overt
