#pragma once
/// Arrays that begin at a cache line. Large ones lie in huge pages, if the system gives them: every cycle goes through all of them, and with pages of 4 kB
/// processors lose time translating addresses.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace hdem
{
template <typename T>
struct HugePageAllocator
{
    using value_type = T;
    static constexpr std::size_t page = std::size_t{1} << 21;
    static constexpr std::size_t least = 4 * page;  ///< smaller arrays nearly fit a cache
    static constexpr std::size_t most = std::size_t{PTRDIFF_MAX} / 2 / sizeof(T);
    static constexpr std::align_val_t alignment{alignof(T) > 64 ? alignof(T) : 64};

    HugePageAllocator() = default;
    template <typename U>
    HugePageAllocator(const HugePageAllocator<U>&)
    {
    }

    [[nodiscard]] T* allocate(std::size_t count)
    {
        if (count > most)
            throw std::bad_array_new_length();
        const std::size_t bytes = count * sizeof(T);
        if (bytes < least)
            return static_cast<T*>(::operator new(bytes, alignment));
        void* const memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
        if (memory == nullptr)
            throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
        static_cast<void>(::madvise(memory, bytes, MADV_HUGEPAGE));  // only a hint; the results do not depend on it
#endif
        return static_cast<T*>(memory);
    }

    void deallocate(T* memory, std::size_t count)
    {
        if (count * sizeof(T) < least)
            ::operator delete(memory, alignment);
        else
            std::free(memory);
    }

    template <typename U>
    bool operator==(const HugePageAllocator<U>&) const
    {
        return true;
    }
};

template <typename T>
using LargeVector = std::vector<T, HugePageAllocator<T>>;
}  // namespace hdem
