/// The table of all keys that a kind of TOML file may have: one row for each key, which says of what it is
/// and into which member of which struct it goes. Who reads such a file, describes it or offers help with it
/// goes through the rows, and needs to know neither the structs nor the types.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/keys/key_rule.h"
#include "experiment/keys/value_type.h"

namespace overt {

/// A struct as it is when its section is left out. Its address also stands for the type.
template <class Struct> const Struct& as_left_out() {
    static const Struct as_it_is{};
    return as_it_is;
}

/// Where a member lies in objects of a struct.
class MemberPlace {
  public:
    template <class Struct, class Member>
    explicit MemberPlace(Member Struct::*member)
        : struct_(&as_left_out<Struct>()), member_(&(as_left_out<Struct>().*member)) {}
    /// An element of a member that is an array.
    template <class Struct, class Value, std::size_t count>
    MemberPlace(std::array<Value, count> Struct::*member, std::size_t index)
        : struct_(&as_left_out<Struct>()), member_(&(as_left_out<Struct>().*member).at(index)) {}
    /// A member of a member that is a struct.
    template <class Struct, class Inner, class Member>
    MemberPlace(Inner Struct::*inner, Member Inner::*member)
        : struct_(&as_left_out<Struct>()), member_(&(as_left_out<Struct>().*inner.*member)) {}
    /// The object as a whole.
    template <class Struct> static MemberPlace whole() {
        return {&as_left_out<Struct>(), &as_left_out<Struct>()};
    }

    /// The member of an object, which must be of the struct.
    const void* in(const void* object) const {
        const std::ptrdiff_t offset =
            static_cast<const std::byte*>(member_) - static_cast<const std::byte*>(struct_);
        return static_cast<const std::byte*>(object) + offset;
    }
    void* in(void* object) const { return const_cast<void*>(in(static_cast<const void*>(object))); }

    /// The member of as_left_out<Struct>(), and this itself.
    const void* in_left_out() const { return member_; }
    const void* left_out_struct() const { return struct_; }

  private:
    MemberPlace(const void* of_struct, const void* member) : struct_(of_struct), member_(member) {}

    const void *struct_, *member_;
};

/// A member that Struct inherits, as one of its own: a key is one of its section's struct.
template <class Struct, class Base, class Value> constexpr Value Struct::*member_of(Value Base::*inherited) {
    return inherited;
}

/// A row of the table: name, member, what may be written if not all that the type can be, meaning.
struct Key {
    /// An enumeration that has names takes these for its choices.
    template <class Struct, class Value>
    Key(std::string_view name, Value Struct::*member, const KeyLimits& limits, std::string_view explanation)
        : rule{limits, name, explanation}, type(&value_type(TypeTag<Value>())), place(member) {
        if (rule.choices.empty())
            rule.choices = type->names;
    }
    template <class Struct, class Value>
    Key(std::string_view name, Value Struct::*member, std::string_view explanation)
        : Key(name, member, KeyLimits{}, explanation) {}
    /// Of an element of a member that is an array.
    template <class Struct, class Value, std::size_t count>
    Key(std::string_view name, std::array<Value, count> Struct::*member, std::size_t index,
        const KeyLimits& limits, std::string_view explanation)
        : rule{limits, name, explanation}, type(&value_type(TypeTag<Value>())), place(member, index) {}

    /// Of a member of a member that is a struct.
    template <class Struct, class Inner, class Value>
    Key(std::string_view name, Inner Struct::*inner, Value Inner::*member, const KeyLimits& limits,
        std::string_view explanation)
        : rule{limits, name, explanation}, type(&value_type(TypeTag<Value>())), place(inner, member) {
        if (rule.choices.empty())
            rule.choices = type->names;
    }

    /// The member of an object of the key's struct, if it is a Value; else null.
    template <class Value> const Value* get_if(const void* object) const {
        return type == &value_type(TypeTag<Value>()) ? static_cast<const Value*>(place.in(object)) : nullptr;
    }

    /// Its default as it is written in a file; empty if it has none of its own.
    std::string default_text() const;

    KeyRule rule;
    const ValueType* type;
    MemberPlace place;
};

/// Where the structs of a section lie in the struct that a whole file becomes.
class SectionHome {
  public:
    /// Of a table within a section whose keys are members of the section's struct.
    SectionHome() = default;
    /// Of a [section], of a [[list]], and of a table within one that has a struct of its own there.
    template <class Root, class Struct>
    SectionHome(Struct Root::*one) : place_(one), left_out_(&as_left_out<Struct>()) {}
    template <class Root, class Struct>
    SectionHome(std::vector<Struct> Root::*list)
        : place_(list), left_out_(&as_left_out<Struct>()), add_([](void* entries) -> void* {
              return &static_cast<std::vector<Struct>*>(entries)->emplace_back();
          }),
          clear_([](void* entries) { static_cast<std::vector<Struct>*>(entries)->clear(); }) {}
    /// Of a table within a section whose keys are names, such as `areas = { rim = { … }, base = { … } }`:
    /// each is an entry of a list in the section's struct, which has its name in `name`.
    template <class Struct, class Entry>
    static SectionHome by_name(std::vector<Entry> Struct::*list, std::string Entry::*name) {
        SectionHome home(list);
        home.name_.emplace(name);
        return home;
    }
    /// Of a table within a section that is one such entry, called as the table is.
    template <class Struct, class Entry>
    static SectionHome one_by_name(std::vector<Entry> Struct::*list, std::string Entry::*name) {
        SectionHome home = by_name(list, name);
        home.is_one_ = true;
        return home;
    }
    /// Of a section whose keys are members of the whole file's struct itself.
    template <class Root> static SectionHome root() {
        SectionHome home;
        home.place_ = MemberPlace::whole<Root>();
        home.left_out_ = &as_left_out<Root>();
        return home;
    }

    bool has_struct() const { return place_.has_value(); }
    bool is_list() const { return add_ != nullptr && !name_; }
    bool is_by_name() const { return name_ && !is_one_; }
    bool is_one_by_name() const { return name_ && is_one_; }
    /// A new entry of a list by names, in an object of the section's struct.
    void* open_named(void* object, std::string name) const {
        void* const entry = add_(place_->in(object));
        *static_cast<std::string*>(name_->in(entry)) = std::move(name);
        return entry;
    }
    /// The section's struct in `root`, or in the struct of the section around it; of a list, a new entry of
    /// it.
    void* open(void* root) const { return is_list() ? add_(place_->in(root)) : place_->in(root); }
    /// Takes out the entries of a list.
    void clear(void* root) const { clear_(place_->in(root)); }

    const void* left_out_root() const { return place_ ? place_->left_out_struct() : nullptr; }
    const void* left_out_struct() const { return left_out_; }

  private:
    std::optional<MemberPlace> place_;
    const void* left_out_ = nullptr;
    void* (*add_)(void* list) = nullptr;
    std::optional<MemberPlace> name_; ///< of entries by name
    bool is_one_ = false;
    void (*clear_)(void* list) = nullptr;
};

/// A [section], the entries of a [[list]], a table within one of them (`head = { … }` of an object), or a
/// list within one (`[[task.answer]]`).
struct Section {
    std::string_view name;
    SectionHome home; ///< of a table within a section: of its struct, if that is not the section's
    std::vector<Key> keys;
    std::string_view explanation = {};
    std::vector<Section> tables = {};
    /// Of a list that is never empty: its only entry may be written as a [section] of this name.
    std::string_view alone = {};

    bool is_list() const { return home.is_list(); }
    bool is_never_empty() const { return !alone.empty(); }
    bool is_called(std::string_view heading) const {
        return heading == name || (!alone.empty() && heading == alone);
    }
    std::string heading() const;      ///< "[name]" or "[[name]]"; "[alone]" of a list that may be one
    std::string list_heading() const; ///< "[[name]]"
    /// The key of its own, and not of a table within it, that is called so; or null.
    const Key* find_key(std::string_view key) const;
};

/// All sections of a kind of file, in the order of its documentation.
class KeyTable {
  public:
    /// All homes must lie in one struct, and a section's keys in the section's.
    explicit KeyTable(std::vector<Section> all, std::string_view key_above_sections = {});

    std::vector<Section>::const_iterator begin() const { return sections_.begin(); }
    std::vector<Section>::const_iterator end() const { return sections_.end(); }

    /// The section of a name that there is.
    const Section& section(std::string_view name) const;

    /// A key that somebody else reads, and that stands before the first section; or empty.
    std::string_view key_above_sections() const { return key_above_; }

    const void* left_out_root() const { return sections_.front().home.left_out_root(); }

  private:
    std::vector<Section> sections_;
    std::string_view key_above_;
};

/// What a key takes, beside its range, which names the unit already: "a number", "one of "cycle",
/// "ping-pong"".
std::string expected_kind(const Key& key);

} // namespace overt
