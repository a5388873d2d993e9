#compdef {{&program}}
{{! zshcompsys(1), _arguments }}
_arguments -s -S{{#operands}} '*:file:_files'{{/operands}}{{#option}} \
    {{#letter}}'(-{{&letter}} --{{&name}})'{-{{&letter}}{{^flag}}+{{/flag}},--{{&name}}{{^flag}}={{/flag}}}'[{{/letter}}{{^letter}}'--{{&name}}{{^flag}}={{/flag}}{{#flag}}{{#choices}}=-{{/choices}}{{/flag}}[{{/letter}}{{&zsh}}]{{#takes}}{{#flag}}:{{/flag}}:{{&name}}:{{#choices}}({{&choices}}){{/choices}}{{^choices}}{{#file}}_files{{/file}}{{^file}} {{/file}}{{/choices}}{{/takes}}'{{/option}}
