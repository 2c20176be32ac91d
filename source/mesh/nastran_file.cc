// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The bulk data of Nastran.

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/mesh_readers.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <climits>
#include <fstream>
#include <map>
#include <set>

#include "abaqus_lines.h"
#include "model_builder.h"

namespace corotet
{
  namespace
  {
    // A card of any number of lines: its name in capitals, and its fields
    // behind the name, with 8 fields per line or, if they are long, 4.
    struct NastranCard
    {
      abaqus::Place            place;
      std::string              name;
      std::vector<std::string> fields;

      // A field without blanks; empty if there is none.
      std::string
      field(const std::size_t i) const
      {
        return i < fields.size() ? fields[i] : "";
      }

      std::uint64_t
      number(const std::size_t i, const std::string &what) const
      {
        const auto result = abaqus::whole_number(field(i));
        if (!result || *result < 1 || *result > INT_MAX)
          place.refuse(fmt::format("{} of a {}: found '{}'; allowed is a "
                                   "positive whole number",
                                   what,
                                   name,
                                   shortened(field(i), 40)));
        return *result;
      }

      // The coordinate in a field. A blank is 0; the E of exponents may be
      // missing, as in "1.-3".
      double
      coordinate(const std::size_t i) const
      {
        std::string text = field(i);
        if (text.empty())
          return 0;
        const std::size_t sign = text.find_first_of("+-", 1);
        if (sign != std::string::npos &&
            std::string("eEdD").find(text[sign - 1]) == std::string::npos)
          text.insert(sign, "e");
        return abaqus::number(text, place);
      }
    };



    // A line with fixed columns or, if it has commas, of free fields.
    class NastranLine
    {
    public:
      explicit NastranLine(std::string text)
      {
        text.resize(std::min(text.find('$'), text.size()));
        const bool is_free = text.find(',') != std::string::npos;
        if (!is_free)
          text = with_blanks(text);
        std::string first =
          is_free ? text.substr(0, text.find(',')) : text.substr(0, 8);
        first    = upper_case(abaqus::trimmed(first));
        is_blank = abaqus::trimmed(text).empty();
        is_long =
          !first.empty() && (first.front() == '*' || first.back() == '*');
        is_continuation = first.empty() || first[0] == '+' || first[0] == '*';
        name            = first.substr(0, first.find('*'));
        const std::size_t n = is_long ? 4 : 8;
        if (is_free)
          {
            std::size_t begin = text.find(',');
            while (begin != std::string::npos && fields.size() < n)
              {
                const std::size_t end = text.find(',', begin + 1);
                fields.push_back(
                  abaqus::trimmed(text.substr(begin + 1, end - begin - 1)));
                begin = end;
              }
          }
        else
          for (std::size_t i = 0; i < n; ++i)
            if (const std::size_t begin = 8 + i * (64 / n); begin < text.size())
              fields.push_back(abaqus::trimmed(text.substr(begin, 64 / n)));
        fields.resize(n);
      }

      bool                     is_blank = false, is_continuation = false;
      std::string              name;
      std::vector<std::string> fields;

    private:
      bool is_long = false;

      // Replaces tabs, which go to the next multiple of eight columns, by
      // blanks.
      static std::string
      with_blanks(const std::string &text)
      {
        std::string result;
        for (const char c : text)
          if (c == '\t')
            result.append(8 - result.size() % 8, ' ');
          else
            result += c;
        return result;
      }
    };



    class NastranReader
    {
    public:
      explicit NastranReader(const std::string &path)
      {
        abaqus::Place place{path, 0};
        std::ifstream file(path);
        if (!file)
          throw MachineError(path + ": cannot be read (permission?)");
        NastranCard card;
        bool        is_at_end = false;
        skip_byte_order_mark(file);
        for (std::string text; !is_at_end && std::getline(file, text);)
          {
            ++place.line;
            const NastranLine line(text);
            if (line.is_blank)
              continue;
            if (line.is_continuation)
              {
                card.fields.insert(card.fields.end(),
                                   line.fields.begin(),
                                   line.fields.end());
                continue;
              }
            add(card);
            card      = {place, line.name, line.fields};
            is_at_end = line.name == "ENDDATA";
          }
        check_read_to_end(file, path);
        add(card);
      }

      GmshModel
      model() const
      {
        GmshModel                result = builder.model();
        std::vector<std::string> remarks;
        if (!left_out.empty())
          remarks.push_back(
            "left out, as corotet reads the mesh only: " +
            shortened(join({left_out.begin(), left_out.end()}), 300));
        for (const auto &[name, n] : n_without_property)
          remarks.push_back(fmt::format(
            "{} {} have no property: each is named by its own number",
            n,
            name));
        result.remark = join(remarks, "; ");
        return result;
      }

    private:
      void
      add(const NastranCard &card)
      {
        static const std::set<std::string> other_solids{
          "CHEXA", "CPENTA", "CPYRA", "CPYRAM", "CHEX8", "CHEX20", "CWEDGE"};
        if (card.name == "GRID")
          add_node(card);
        else if (card.name == "GRDSET")
          check_system(card);
        else if (card.name == "CTETRA")
          add_tetrahedron(card);
        else if (card.name == "CTRIA3" || card.name == "CTRIA6" ||
                 card.name == "CTRIAR")
          add_element(card, 2, card_nodes(card, 3));
        else if (other_solids.contains(card.name))
          card.place.refuse("cells other than tetrahedra: found " + card.name +
                            "; allowed is CTETRA");
        else if (card.name.starts_with('='))
          card.place.refuse(
            "cards that repeat others (=) are not read; allowed "
            "is each card written out");
        else if (card.name == "BEGIN BU")
          // The statements before are not cards of the bulk data.
          left_out.clear();
        else if (card.name != "ENDDATA" && is_name(card.name))
          left_out.insert(card.name);
      }

      static bool
      is_name(const std::string &name)
      {
        return !name.empty() &&
               std::all_of(name.begin(), name.end(), [](const unsigned char c) {
                 return std::isalnum(c) != 0;
               });
      }

      // Refuses coordinate systems that would turn and shift the coordinates.
      static void
      check_system(const NastranCard &card)
      {
        if (const std::string system = card.field(1);
            !system.empty() && system != "0")
          card.place.refuse(
            fmt::format("coordinates in a system of their own (CP) are not "
                        "read: found {} in a {}; allowed are 0 and a blank, "
                        "the basic system",
                        shortened(system, 40),
                        card.name));
      }

      void
      add_node(const NastranCard &card)
      {
        check_system(card);
        const std::uint64_t number = card.number(0, "the number");
        if (!builder.add_node(
              number,
              {card.coordinate(2), card.coordinate(3), card.coordinate(4)}))
          card.place.refuse(
            fmt::format("node {} is there already, at another place", number));
      }

      static std::vector<std::uint64_t>
      card_nodes(const NastranCard &card, const std::size_t n)
      {
        std::vector<std::uint64_t> nodes;
        for (std::size_t i = 0; i < n; ++i)
          nodes.push_back(card.number(2 + i, "a node"));
        return nodes;
      }

      void
      add_tetrahedron(const NastranCard &card)
      {
        // Nastran has no higher degree, but gmsh writes such cards.
        for (std::size_t i = 2 + 10; i < card.fields.size(); ++i)
          if (!card.field(i).empty())
            card.place.refuse(
              fmt::format("a CTETRA has 4 or 10 nodes: found '{}' behind them",
                          shortened(card.field(i), 40)));
        std::size_t n_given = 0;
        for (std::size_t i = 4; i < 10; ++i)
          n_given += card.field(2 + i).empty() ? 0 : 1;
        if (n_given != 0 && n_given != 6)
          card.place.refuse(fmt::format("a CTETRA has no nodes on its edges or "
                                        "all six of them: found {}",
                                        n_given));
        const auto nodes = card_nodes(card, 4 + n_given);
        if (n_given == 0)
          {
            add_element(card, 4, nodes);
            return;
          }
        // gmsh has the last two nodes in opposite order.
        std::vector<std::uint64_t> theirs(nodes);
        std::swap(theirs[8], theirs[9]);
        add_element(card, 11, theirs);
      }

      // Adds an element to the group of its property; without one, to the group
      // with the number of the element.
      void
      add_element(const NastranCard                &card,
                  const int                         type,
                  const std::vector<std::uint64_t> &nodes)
      {
        const std::uint64_t label = card.number(0, "the number");
        if (labels.add(label))
          card.place.refuse(fmt::format("element {} is there already", label));
        const std::size_t element      = builder.add_element(type, nodes);
        const bool        has_property = !card.field(1).empty();
        if (!has_property)
          ++n_without_property[card.name];
        builder.add_to_group(element,
                             static_cast<int>(has_property ?
                                                card.number(1, "the property") :
                                                label));
      }

      ModelBuilder builder;
      // The numbers of the elements.
      GivenNumbers labels;
      // The number of elements without a property, by the names of cards.
      std::map<std::string, std::size_t> n_without_property;
      std::set<std::string>              left_out;
    };
  } // namespace



  GmshModel
  read_nastran(const std::string &path)
  {
    return NastranReader(path).model();
  }
} // namespace corotet
