#pragma once
/// An object whose __init__ has failed is still at hand for a debugger, and for who made it by __new__: it holds nothing, and says so when it is asked.
/// Without that pybind11 gives it memory that nobody has filled.

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
