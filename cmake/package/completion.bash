# Bash completion of Swath's programs, which list their options, commands and built-in models themselves (--help).

# _swath_values PROGRAM OPTION: prints the values of an option that takes one of a few.
_swath_values() {
    case $2 in
        --algorithm) echo hybrid mahd kd-split sort-last ;;
        --renderer) echo raster osmesa egl raycast ;;
        --cull) echo wide a2ssb adsb none ;;
        --objects-by) echo uniform sah ;;
        --path) echo orbit random ;;
        --format) echo png jpeg ;;
        --trees-on) echo threads cuda ;;
        --hardware) "$1" hardware 2>/dev/null | sed 's/ .*//' ;;
    esac
}

_swath() {
    local program=${1/#\~/$HOME} word=$2 before=$3 command="" help values i
    # Bash takes --option=value and builtin:name for three words each.
    if [[ $word == [=:] ]]; then
        before=$word word=""
    fi
    [[ $before != = ]] || before=${COMP_WORDS[COMP_CWORD - 1 - (${#word} > 0)]}
    if [[ $program == *swath-sim ]]; then
        for ((i = 1; i < COMP_CWORD; i++)); do
            [[ ${COMP_WORDS[i]} != [a-z]* ]] || { command=${COMP_WORDS[i]}; break; }
        done
    fi
    # shellcheck disable=SC2086
    help=$("$program" $command --help 2>/dev/null) || return

    if [[ $word == -* ]]; then
        values=$(grep -oE '^ {2,10}(-[a-z],? *)?--[a-z-]+' <<<"$help" | grep -oE -- '-[a-z-]+')
    elif [[ $before == : ]]; then
        values=$(grep -oE '^ +builtin:[a-z]+' <<<"$(swath-client --help 2>/dev/null)" | sed 's/.*://')
    elif [[ $program == *swath-sim && -z $command ]]; then
        values=$(sed -nE '/^subcommands:/I,/^[^ ]*$/s/^  ([a-z]+) .*/\1/p' <<<"$help")
    elif [[ $before == -* ]]; then
        values=$(_swath_values "$program" "$before")
    fi
    # Several values stand with commas between.
    mapfile -t COMPREPLY < <(compgen -P "${word%"${word##*,}"}" -W "${values:-}" -- "${word##*,}")
    [[ $word == -* || $before == : || -n ${values:-} && $before != --path && $before != --hardware ]] ||
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$word")
}
complete -o filenames -F _swath swath-client swath-display swath-server swath-sim
