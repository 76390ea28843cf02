#pragma once
/// Objects whose __init__ has failed or has not run. A debugger, or code that called __new__, can still use such an object; it holds nothing, and each use
/// throws an error.
/// Otherwise pybind11 would give it memory that nobody has filled.

#include <pybind11/pybind11.h>

#include <stdexcept>

namespace hdem
{
template <class T>
class CasterOfMade : public pybind11::detail::type_caster_base<T>
{
  public:
    bool load(pybind11::handle source, bool convert)
    {
        namespace detail = pybind11::detail;
        const detail::type_info* const type = detail::get_type_info(typeid(T));
        if (type != nullptr && pybind11::isinstance<T>(source) &&
            reinterpret_cast<detail::instance*>(source.ptr())->get_value_and_holder(type).value_ptr() == nullptr)
            throw std::runtime_error("this object was never made: its __init__ has failed, or has not run");
        return detail::type_caster_base<T>::load(source, convert);
    }
};
}  // namespace hdem
