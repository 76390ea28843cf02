#include "io/hdf5_handle.h"

#include "core/check.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>

namespace hdem
{
namespace
{
struct Users
{
    std::mutex mutex;
    std::condition_variable gone;
    int count = 0;
};

thread_local int own_uses = 0;  // the thread that forks does not wait for itself

Users& users();

void before_fork()
{
    std::unique_lock lock(users().mutex);
    users().gone.wait(lock, [] { return users().count <= std::max(own_uses, 0); });
    lock.release();  // nobody begins until the fork is done
}

/// In both processes.
void after_fork()
{
    users().mutex.unlock();
}

Users& users()
{
    static Users& all = *new Users;  // threads may outlive main()
    return all;
}

/// As the program or module is loaded: a process forked off while a thread of ours uses the library for the first time would find it half begun.
[[maybe_unused]] const int watches_forks = (users(), ::pthread_atfork(before_fork, after_fork, after_fork));

struct StoredType
{
    hid_t native;
    hid_t stored;
    std::size_t size;
};

StoredType types_of(ElementType type)
{
    switch (type)
    {
    case ElementType::float64:
        return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 8};
    case ElementType::float32:
        return {H5T_NATIVE_FLOAT, H5T_IEEE_F32LE, 4};
    case ElementType::int64:
        return {H5T_NATIVE_INT64, H5T_STD_I64LE, 8};
    case ElementType::uint64:
        return {H5T_NATIVE_UINT64, H5T_STD_U64LE, 8};
    case ElementType::int32:
        return {H5T_NATIVE_INT32, H5T_STD_I32LE, 4};
    case ElementType::uint8:
        break;
    }
    return {H5T_NATIVE_UINT8, H5T_STD_U8LE, 1};
}

herr_t append_reason(unsigned, const H5E_error2_t* error, void* data)
{
    auto& reason = *static_cast<std::string*>(data);
    if (reason.empty() && error->desc != nullptr)
        reason = error->desc;
    return 0;
}
}  // namespace

Hdf5Use::Hdf5Use()
{
    const std::lock_guard lock(users().mutex);
    ++users().count;
    ++own_uses;
}

Hdf5Use::~Hdf5Use()
{
    const std::lock_guard lock(users().mutex);
    --users().count;
    --own_uses;
    users().gone.notify_all();
}

void prepare_hdf5()
{
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0);  // a file must not decide which code is loaded
}

std::string hdf5_reason()
{
    std::string reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, append_reason, &reason);
    return reason.empty() ? "no reason known" : reason;
}

void fail_hdf5(const std::filesystem::path& file, const std::string& object, const char* action, const std::string& reason)
{
    throw RunError(fmt::format("{}: {}: cannot be {} ({}).", file.string(), object, action, reason));
}

hid_t native_type(ElementType type)
{
    return types_of(type).native;
}

hid_t stored_type(ElementType type)
{
    return types_of(type).stored;
}

std::size_t element_size(ElementType type)
{
    return types_of(type).size;
}
}  // namespace hdem
