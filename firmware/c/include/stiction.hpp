// stiction for C++: a solver that owns its memory. No exceptions, no heap; every function returns a stiction_result.
#ifndef STICTION_HPP
#define STICTION_HPP

#include "stiction.h"

namespace stiction_cpp {

/// A solver of one scene with its run; a copy of it is a run of its own.
class Solver {
public:
    /// error: receives what is wrong with the scene; may be null. `result()` returns the result.
    explicit Solver(const stiction_scene &scene, stiction_error *error = nullptr) noexcept
        : result_(stiction_init(&memory_, sizeof memory_, STICTION_ABI, &scene, error)) {}

    /// Whether the scene can be used.
    stiction_result result() const noexcept { return result_; }
    explicit operator bool() const noexcept { return result_ == STICTION_RESULT_OK; }

    /// See stiction_set_budget.
    stiction_result set_budget(uint32_t units) noexcept { return stiction_set_budget(&memory_, units); }
    /// See stiction_set_evolution.
    stiction_result set_evolution(uint8_t evolution) noexcept { return stiction_set_evolution(&memory_, evolution); }
    /// See stiction_start.
    stiction_result start(const stiction_hand &hand, stiction_output *output = nullptr) noexcept {
        return stiction_start(&memory_, &hand, output);
    }
    /// See stiction_step.
    stiction_result step(const stiction_hand &hand, stiction_output *output = nullptr) noexcept {
        return stiction_step(&memory_, &hand, output);
    }
    /// See stiction_wrench.
    stiction_result wrench(stiction_wrench_on_body &wrench) const noexcept { return stiction_wrench(&memory_, &wrench); }
    /// See stiction_contacts; `contacts` has room for STICTION_CONTACTS.
    stiction_result contacts(stiction_contact *contacts, uint32_t &count) const noexcept {
        return stiction_contacts(&memory_, contacts, &count);
    }
    /// See stiction_take_snapshot.
    stiction_result take_snapshot(stiction_snapshot &snapshot) const noexcept {
        return stiction_take_snapshot(&memory_, &snapshot);
    }
    /// See stiction_restore.
    stiction_result restore(const stiction_snapshot &snapshot) noexcept { return stiction_restore(&memory_, &snapshot); }

private:
    ::stiction memory_;
    stiction_result result_;
};

} // namespace stiction_cpp

#endif
