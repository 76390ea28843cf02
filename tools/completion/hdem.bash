# Completion of hdem's commands, options and files for bash; installed where bash-completion looks for it.
# A test compares the words with what `hdem --help` says.

_hdem_words()
{
    case "$1" in
        run) echo "-o --output --restart --overwrite --max-wall --method --threads --set --live -q --quiet -h --help" ;;
        critical) echo "--vary --fails --tolerance -o --output --overwrite --threads --set -q --quiet -h --help" ;;
        fos) echo "-o --output --overwrite --threads --set -q --quiet -h --help" ;;
        check) echo "--set --write-blocks --blocks -h --help" ;;
        info) echo "-h --help" ;;
        schema) echo "--markdown -h --help" ;;
        plot) echo "-o --output --colour --frame --excavation --window --range --contacts --joints --numbers --bolts --liners --crosses --history --energy --factor --title --width --dpi -h --help" ;;
        report) echo "-o --output -h --help" ;;
        view) echo "-o --output --contacts --movie --colour --fps --window --width -h --help" ;;
        *) echo "run fos critical check info schema plot report view --version -h --help" ;;
    esac
}

_hdem()
{
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=""
    [[ $COMP_CWORD -gt 1 ]] && command=${COMP_WORDS[1]}
    COMPREPLY=()
    case "$before" in
        --method) mapfile -t COMPREPLY < <(compgen -W "force impulse hybrid" -- "$word"); return ;;
        --colour) mapfile -t COMPREPLY < <(compgen -W "displacement displacement_x displacement_y rotation velocity stress stress_xx stress_yy stress_xy regime material none" -- "$word"); return ;;
        --frame) mapfile -t COMPREPLY < <(compgen -W "last" -- "$word"); return ;;
        --threads) mapfile -t COMPREPLY < <(compgen -W "auto" -- "$word"); return ;;
        --max-wall | --set | --vary | --fails | --tolerance | --window | --range | --history | --title | --width | --dpi) return ;;
    esac
    if [[ $word == -* || -z $command ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_hdem_words "$command")" -- "$word")
        return
    fi
    compopt -o filenames 2>/dev/null
    case "$command" in
        run | check | fos | critical) mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$word"; compgen -d -- "$word") ;;
        *) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    esac
}
complete -F _hdem hdem
