#pragma once
/// Newton's iteration from one list of contacts to balance.

#include "core/statics/static_blocks.h"
#include "parallel/contact_rebuild.h"
#include "parallel/factorisation.h"
#include "parallel/gmres.h"
#include "parallel/piece_sums.h"
#include "parallel/static_solver.h"

namespace hdem
{
/// Works on `state` in place: its places, and on commit the history of its contacts.
class StaticSearch
{
  public:
    enum class End
    {
        in_balance,
        in_balance_from_the_start,
        nearly_in_balance,  ///< within what is accepted, and no better: a block rests where the law of a contact jumps
        gave_up
    };

    /// @param given  force and moment on each block besides its weight, or empty
    StaticSearch(const Model& model, State& state, int threads, const StaticRule& rule, std::vector<Triple> given = {});

    /// Find contacts and features at the present places, and begin there.
    void find_contacts();
    /// Iterate until the blocks are in balance. At least half of each step is taken first. Where that brings no progress any more, the search begins once more,
    /// with steps as short as the energy asks for.
    End run();
    /// Iterate as often as the rule allows, whether or not balance is reached.
    void advance() { iterate({}); }
    /// The places and forces found become the next start.
    void commit();

    /// Blocks that have come away are unknowns of the next search again. False if there are none.
    bool let_stand_again();

    [[nodiscard]] int iterations() const { return iterations_; }
    [[nodiscard]] int solves() const { return solves_; }
    [[nodiscard]] double ratio() const { return whole_.imbalance.ratio(); }
    [[nodiscard]] double friction() const { return friction_; }
    /// Has it had to begin again, with shorter steps? Then its answer may depend on the path.
    [[nodiscard]] bool has_begun_again() const { return begun_again_; }
    /// Force and moment on each block of the model where the last search for contacts has found it, weight and given forces included.
    [[nodiscard]] std::vector<Triple> net_forces_at_start();
    [[nodiscard]] const std::vector<std::uint8_t>& is_held() const { return is_held_; }
    /// Held blocks; after a search was given up, also those that moved. Ascending.
    [[nodiscard]] std::vector<Index> loose() const;

  private:
    /// Which part of the step is taken, and how far a point may go.
    struct Pass
    {
        double least_share = 0.5;
        double far_share = 0.1;
    };

    /// Blocks that are sought together, the others where they are, and the linear system of a step.
    struct Part
    {
        Unknowns unknowns;
        std::vector<Index> contacts;  ///< that touch them, ascending; of the whole model: all, and none is listed
        bool is_whole = true;
        bool has_prescribed = false;
        BlockMatrix tangent, symmetric;
        Factorisation factor;
        std::vector<double> net, solution;  ///< three per unknown
        Imbalance imbalance;
    };

    void begin();
    void keep_features(const Contacts& before);
    void number();
    End iterate(const Pass& pass);
    void number(Part& part, Unknowns unknowns);
    void find_imbalance(Part& part, bool frozen, bool along_step);
    void find_loads(const Part& part, bool frozen);
    void sum_up(Part& part, bool along_step);
    PointTally renew(const Part& part, const PointRule& rule);
    void restrain(const Part& part, double far);
    bool hold_loose();
    bool freeze_worst();
    [[nodiscard]] bool too_many_held() const;
    bool find_step(Part& part);
    [[nodiscard]] double greatest_way_of_step(const Part& part);
    void shorten_step(Part& part, double far_share, double next_far_share);
    bool take_step(Part& part, double least_share);
    void place(const Part& part, double share);
    void relax_spots();
    [[nodiscard]] std::vector<Index> blocks_around_spots() const;
    void add_rings(std::vector<Index>& near) const;
    void number_spots(std::vector<Index> blocks);
    void step_spots(double goal);
    [[nodiscard]] bool is_balanced(const StaticRule& goal) const;
    /// work(range) for all contacts of a part, returning a sum.
    template <typename Sum, typename Work>
    Sum sum_contacts(const Part& part, const Work& work)
    {
        if (part.is_whole)
            return sum_pieces<Sum>(threads_, state_.contacts.size(), work);
        return sum_pieces<Sum>(threads_, static_cast<Index>(part.contacts.size()),
                               [&](IndexRange range)
                               {
                                   Sum sum{};
                                   for (Index k = range.begin; k < range.end; ++k)
                                       sum += work(IndexRange{part.contacts[k], part.contacts[k] + 1});
                                   return sum;
                               });
    }
    template <typename Work>
    void for_contacts(const Part& part, const Work& work)
    {
        sum_contacts<Nothing>(part,
                              [&](IndexRange range)
                              {
                                  work(range);
                                  return Nothing{};
                              });
    }

    const Model& model_;
    State& state_;
    int threads_;
    StaticRule rule_;
    std::vector<Triple> given_;

    ContactRebuild rebuild_;
    std::vector<BlockMotion> start_;     ///< places where the search began
    std::vector<double> moved_, step_;   ///< since then, and by the last solution: three per block of the model
    std::vector<double> from_;           ///< moved_ before the step
    std::vector<std::uint8_t> is_held_;  ///< per block: Held
    std::vector<Index> moving_;          ///< blocks that moved when the search was given up

    std::vector<StaticPoint> points_;  ///< two per contact
    std::vector<ContactTangent> tangents_;
    std::vector<BlockLoad> loads_;
    BlockContacts list_;
    Part whole_, spots_;
    Gmres gmres_;

    PointTally tally_;
    double block_size_ = 0.0;  ///< of the middle block [m]
    double far_ = 0.0;         ///< a point that moves farther has left its place [m]
    double friction_ = 0.0;
    int searches_ = 0;
    int iterations_ = 0;
    int solves_ = 0;
    bool begun_again_ = false;
};
}  // namespace hdem
