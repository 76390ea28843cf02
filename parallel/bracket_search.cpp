#include "parallel/bracket_search.h"

#include <algorithm>
#include <exception>
#include <thread>

namespace hdem
{
namespace
{
class Search
{
  public:
    Search(const BracketRule& rule, int threads, const StandsAt& stands, const AfterPair& after)
        : rule_(rule),
          threads_(threads),
          stands_(stands),
          after_(after)
    {
    }

    Bracket run()
    {
        if (rule_.known.is_closed())
            found_ = rule_.known;
        else if (rule_.guess)
            look_at(std::max(*rule_.guess - 0.5 * rule_.tolerance, rule_.least),
                    std::min(*rule_.guess + 0.5 * rule_.tolerance, rule_.most));
        else
            look_at(rule_.low, rule_.high);
        while (!found_.stands && *found_.fails > rule_.least)
            go_down();
        while (!found_.fails && *found_.stands < rule_.most)
            go_up();
        while (found_.is_closed() && is_to_be_divided())
            divide();
        return found_;
    }

  private:
    void go_down()
    {
        const double fails = *found_.fails;
        const double low = std::max(fails > rule_.low ? rule_.low : 0.5 * fails, rule_.least);
        look_at(low, 0.5 * (low + fails));
    }

    void go_up()
    {
        const double stands = *found_.stands;
        const double high = std::min(stands < rule_.high ? rule_.high : 2.0 * stands, rule_.most);
        look_at(0.5 * (stands + high), high);
    }

    /// Wider than the tolerance, and than round-off.
    [[nodiscard]] bool is_to_be_divided() const
    {
        const double low = *found_.stands, high = *found_.fails, width = high - low;
        return width > rule_.tolerance * (1.0 + 1e-9) && low + width / 3.0 > low && low + 2.0 * (width / 3.0) < high;
    }

    void divide()
    {
        const double low = *found_.stands, third = (*found_.fails - low) / 3.0;
        if (3.0 * third < 2.0 * rule_.tolerance)
            look_at(low + 1.5 * third);
        else
            look_at(low + third, low + 2.0 * third);
    }

    void take(double x, bool stands) { (stands ? found_.stands : found_.fails) = x; }

    void look_at(double x)
    {
        take(x, stands_(x, threads_, {}));
        if (after_)
            after_(found_);
    }

    void look_at(double first, double second)
    {
        if (!(first < second))
            return look_at(first);
        const auto [stands, also] = threads_ > 1 ? at_once(first, second) : in_turn(first, second);
        take(first, stands);
        if (stands)
            take(second, also);
        if (after_)
            after_(found_);
    }

    [[nodiscard]] std::pair<bool, bool> in_turn(double first, double second) const
    {
        const bool stands = stands_(first, threads_, {});
        return {stands, stands && stands_(second, threads_, {})};
    }

    [[nodiscard]] std::pair<bool, bool> at_once(double first, double second) const
    {
        bool also = false;
        std::exception_ptr error;
        std::jthread other(
            [&](const std::stop_token& stop)
            {
                try
                {
                    also = stands_(second, threads_ / 2, stop);
                }
                catch (...)
                {
                    error = std::current_exception();
                }
            });
        const bool stands = stands_(first, threads_ - threads_ / 2, {});
        if (!stands)
            other.request_stop();
        other.join();
        if (stands && error)
            std::rethrow_exception(error);
        return {stands, also};
    }

    BracketRule rule_;
    int threads_;
    const StandsAt& stands_;
    const AfterPair& after_;
    Bracket found_;
};
}  // namespace

Bracket search_bracket(const BracketRule& rule, int threads, const StandsAt& stands, const AfterPair& after)
{
    return Search(rule, threads, stands, after).run();
}
}  // namespace hdem
