#pragma once
/// Room for many doubles.

#include <array>
#include <cstddef>
#include <memory>

namespace hdem
{
/// Begins at a cache line and is not set to zero: memory that is never touched is never taken.
class NumberBuffer
{
  public:
    /// Make room for `size` numbers. The contents are lost when the buffer has to grow.
    void grow(std::size_t size)
    {
        if (size <= size_)
            return;
        lines_.reset();
        size_ = (size + 7) / 8 * 8;
        lines_ = std::make_unique_for_overwrite<Line[]>(size_ / 8);
    }
    [[nodiscard]] double* data() { return lines_ ? lines_[0].value.data() : nullptr; }
    [[nodiscard]] const double* data() const { return lines_ ? lines_[0].value.data() : nullptr; }
    [[nodiscard]] std::size_t size() const { return size_; }

  private:
    struct alignas(64) Line
    {
        std::array<double, 8> value;
    };
    std::unique_ptr<Line[]> lines_;
    std::size_t size_ = 0;
};
}  // namespace hdem
