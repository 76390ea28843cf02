#pragma once
/// XXH3 of numbers, one after the other.

#include <xxhash.h>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <type_traits>

namespace hdem
{
class HashStream
{
  public:
    HashStream() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }

    /// Every number counts as a double; -0 counts as 0.
    void add(double value)
    {
        const double positive_zero = value + 0.0;
        XXH3_64bits_update(state_.get(), &positive_zero, sizeof positive_zero);
    }
    void add(std::initializer_list<double> values)
    {
        for (const double value : values)
            add(value);
    }
    void add_bytes(const void* from, std::size_t size) { XXH3_64bits_update(state_.get(), from, size); }

    [[nodiscard]] std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

  private:
    struct Free
    {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, Free> state_;
};
}  // namespace hdem
