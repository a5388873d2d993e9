{{! Bash splits --NAME=VALUE into three words. }}
_{{&program}}()
{
    local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} words
    [[ $word == = ]] && word=
    [[ $option == = ]] && option=${COMP_WORDS[COMP_CWORD - 2]}
    case $option in
{{#option}}
{{#words}}
    --{{&name}}{{#letter}} | -{{&letter}}{{/letter}}) words='{{&words}}' ;;
{{/words}}
{{/option}}
    *)
        [[ $word == -* ]] || return
        words='{{#option}}--{{&name}} {{/option}}'
        ;;
    esac
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _{{&program}} {{&program}}
