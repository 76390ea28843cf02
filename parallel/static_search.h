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
    /// Twice at most: with steps of half at least until they bring nothing any more, then from the start again with steps as short as the energy asks for.
    End run();
    /// From where it began as far as the iterations of the rule go, whatever that brings.
    void advance() { iterate({}); }
    /// The places and forces found become the next start.
    void commit();

    [[nodiscard]] int iterations() const { return iterations_; }
    [[nodiscard]] int solves() const { return solves_; }
    [[nodiscard]] double ratio() const { return imbalance_.ratio(); }
    [[nodiscard]] double friction() const { return friction_; }
    [[nodiscard]] const std::vector<std::uint8_t>& is_held() const { return is_held_; }
    /// Held blocks, and after giving up those that moved as well; ascending.
    [[nodiscard]] std::vector<Index> loose() const;

  private:
    /// Which part of the step is taken, and how far a point may go.
    struct Pass
    {
        double least_share = 0.5;
        double far_share = 0.1;
    };

    void begin();
    void keep_features(const Contacts& before);
    void number();
    End iterate(const Pass& pass);
    void find_imbalance(bool frozen, bool along_step);
    bool hold_loose();
    bool freeze_worst();
    [[nodiscard]] bool too_many_held() const;
    bool find_step();
    [[nodiscard]] double greatest_way_of_step();
    void take_step(double least_share);
    void place(double share);
    [[nodiscard]] bool is_balanced(const StaticRule& goal) const;
    [[nodiscard]] IndexRange contacts() const { return {0, state_.contacts.size()}; }
    template <typename Work>
    void for_contacts(const Work& work)
    {
        sum_pieces<Nothing>(threads_, state_.contacts.size(),
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
    Unknowns unknowns_;
    bool has_prescribed_ = false;
    BlockMatrix tangent_, symmetric_;
    Factorisation factor_;
    Gmres gmres_;
    std::vector<double> net_, solution_;  ///< three per unknown

    PointTally tally_;
    Imbalance imbalance_;
    double block_size_ = 0.0;  ///< of the middle block [m]
    double far_ = 0.0;         ///< a point that moves farther has left its place [m]
    double friction_ = 0.0;
    int searches_ = 0;
    int iterations_ = 0;
    int solves_ = 0;
};
}  // namespace hdem
